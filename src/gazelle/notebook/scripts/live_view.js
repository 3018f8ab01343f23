// Puts the live page into a cell, where this browser reaches it. MARK, PATH, PORT and HEIGHT are
// filled in.
(() => {
  const mark = MARK;
  const path = PATH;
  const port = PORT;
  const height = HEIGHT;
  // The same name as the notebook's: pages of another site may not keep anything.
  const isHere = ['localhost', '127.0.0.1'].includes(location.hostname);
  const base = `http://${isHere ? location.hostname : '127.0.0.1'}:${port}${path}`;
  const looks = document.body.dataset.jpThemeLight ?? String(!/dark/.test(document.body.className));
  const boxes = document.querySelectorAll(`[data-gazelle-view="${mark}"]:not([data-ready])`);
  for (const box of boxes) {
    box.dataset.ready = 'yes';
    const probe = new Image();
    probe.onload = () => {
      const frame = document.createElement('iframe');
      frame.referrerPolicy = 'origin';
      frame.allow = 'fullscreen';
      frame.style.cssText = `width:100%;height:${height}px;border:0;border-radius:6px`;
      frame.title = 'Gazelle';
      frame.src = `${base}?panels=notebook&theme=${looks === 'true' ? 'light' : 'dark'}`;
      box.replaceChildren(frame);
    };
    probe.src = `${base}icon.svg?${Date.now()}`;
  }
})();
