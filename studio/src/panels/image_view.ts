/** Image View: one image topic, with zoom, the pixel below the pointer and saving. */

import type { Channel } from '../channel';
import { bytes, type Frame } from '../binary_frame';
import { textOf, textsOf, type JsonObject } from '../json';
import { button, h, notice, select, setText, spacer, toolbar } from '../widgets/dom';
import { download } from '../widgets/download';
import { nameInput } from '../widgets/name_input';
import { BasePanel } from './base';

const TYPES = ['sensor_msgs/Image', 'sensor_msgs/CompressedImage'];
const ZOOMS = [
  ['fit', 'Fit'],
  ['0.5', '50 %'],
  ['1', '100 %'],
  ['2', '200 %'],
  ['4', '400 %'],
] as const;
const COLORMAPS = [
  ['gray', 'Gray'],
  ['hot', 'Hot'],
  ['jet', 'Jet'],
  ['rainbow', 'Rainbow'],
] as const;

/** rqt_image_view. */
export class ImageView extends BasePanel {
  readonly title = 'Image View';
  private topic = '';
  private colormap = 'gray';
  private zoom = 'fit';
  private channel: Channel | null = null;
  private source: [number, number] = [0, 0];
  private readonly canvas = h('canvas', { class: 'picture', role: 'img', 'aria-label': 'Image' });
  private readonly stage = h(
    'div',
    { class: 'stage', tabindex: 0, 'aria-label': 'Image area: the wheel zooms' },
    this.canvas,
  );
  private readonly info = h('span', { class: 'dim' });
  private readonly pixel = h('output', { class: 'mono', 'aria-label': 'Pixel' });
  private readonly empty = notice('Choose an image topic.');
  private readonly input: HTMLInputElement;
  private readonly zoomChoice: HTMLSelectElement;
  private readonly mapChoice: HTMLSelectElement;

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('image');
    this.input = nameInput({
      label: 'Image topic',
      names: () => this.topics(),
      chosen: (name) => this.watch(name),
    });
    this.zoomChoice = select('Zoom', ZOOMS, this.zoom, (value) => this.setZoom(value));
    this.mapChoice = select('Colors of depth', COLORMAPS, this.colormap, (value) => {
      this.colormap = value;
      this.channel?.change(this.params());
      this.host.touched();
    });
    this.element.append(
      toolbar(
        'Image view',
        h('span', {}, this.input),
        this.zoomChoice,
        this.mapChoice,
        spacer(),
        button('', () => this.save(), { icon: 'save', title: 'Save the image as PNG' }),
      ),
      h('div', { class: 'stage-box' }, this.stage, this.empty),
      h('div', { class: 'status-line' }, this.info, spacer(), this.pixel),
    );
    this.stage.addEventListener('pointermove', (event) => this.showPixel(event));
    this.stage.addEventListener('pointerleave', () => setText(this.pixel, ''));
    this.stage.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    this.setZoom(this.zoom);
  }

  override open(params: JsonObject): void {
    this.colormap = textOf(params, 'colormap', this.colormap);
    this.mapChoice.value = this.colormap;
    this.setZoom(textOf(params, 'zoom', this.zoom));
    const topic =
      textOf(params, 'topic') || textsOf(params, 'args')[0] || textsOf(params, 'topics')[0];
    if (topic) this.watch(topic);
    else if (!this.topic) this.watchFirst();
  }

  override state(): JsonObject {
    return { topic: this.topic, colormap: this.colormap, zoom: this.zoom };
  }

  private topics(): string[] {
    return this.host.graph
      .topicsOf(TYPES)
      .filter((topic) => topic.publishers.length > 0)
      .map((topic) => topic.name);
  }

  /** Takes the first image topic that there is or will be. */
  private watchFirst(): void {
    const end = this.host.graph.watch(() => {
      if (this.topic === '' && this.topics().length > 0) this.watch(this.topics()[0]);
    });
    this.atEnd(end);
  }

  private watch(topic: string): void {
    this.topic = topic;
    this.input.value = topic;
    this.host.setTitle(topic ? `Image ${topic}` : this.title);
    this.host.touched();
    if (this.channel) this.endStream(this.channel);
    this.channel = null;
    if (!topic) return;
    setText(this.info, 'waiting for an image');
    this.channel = this.stream('image', this.params(), {
      onFrame: (frame) => this.draw(frame),
      onStatus: (level, text) => {
        if (level !== 'ok') setText(this.info, text);
      },
    });
  }

  private params(): JsonObject {
    return { topic: this.topic, quality: 80, max_width: 1280, colormap: this.colormap };
  }

  private async draw(frame: Frame): Promise<void> {
    const picture = await createImageBitmap(new Blob([bytes(frame)], { type: 'image/jpeg' }));
    const { canvas } = this;
    if (canvas.width !== picture.width || canvas.height !== picture.height) {
      canvas.width = picture.width;
      canvas.height = picture.height;
      this.setZoom(this.zoom);
    }
    canvas.getContext('2d')?.drawImage(picture, 0, 0);
    picture.close();
    this.source = [frame.count >>> 16, frame.count & 0xffff];
    this.empty.hidden = true;
    setText(this.info, `${this.source[0]} × ${this.source[1]}   ${frame.stamp_s.toFixed(2)} s`);
  }

  private setZoom(zoom: string): void {
    this.zoom = zoom;
    this.zoomChoice.value = ZOOMS.some(([value]) => value === zoom) ? zoom : '';
    const fit = zoom === 'fit';
    this.stage.classList.toggle('fit', fit);
    this.canvas.style.width =
      fit || this.source[0] === 0 ? '' : `${this.source[0] * Number(zoom)}px`;
    this.host.touched();
  }

  private wheel(event: WheelEvent): void {
    if (this.source[0] === 0) return;
    event.preventDefault();
    const now = this.canvas.getBoundingClientRect().width / this.source[0];
    const next = Math.min(16, Math.max(0.1, now * Math.exp(-event.deltaY * 0.0015)));
    this.setZoom(String(Number(next.toPrecision(3))));
  }

  private showPixel(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    if (this.source[0] === 0 || box.width === 0) return;
    const scale = Math.min(box.width / this.canvas.width, box.height / this.canvas.height);
    const left = box.left + (box.width - this.canvas.width * scale) / 2;
    const top = box.top + (box.height - this.canvas.height * scale) / 2;
    const x = Math.floor((event.clientX - left) / scale);
    const y = Math.floor((event.clientY - top) / scale);
    if (x < 0 || y < 0 || x >= this.canvas.width || y >= this.canvas.height) {
      setText(this.pixel, '');
      return;
    }
    const data = this.canvas
      .getContext('2d', { willReadFrequently: true })
      ?.getImageData(x, y, 1, 1).data ?? [0, 0, 0];
    const u = Math.floor((x * this.source[0]) / this.canvas.width);
    const v = Math.floor((y * this.source[1]) / this.canvas.height);
    setText(this.pixel, `x ${u}  y ${v}   rgb ${data[0]} ${data[1]} ${data[2]}`);
  }

  private save(): void {
    if (this.source[0] === 0) {
      this.host.fail(new Error('There is no image to save yet.'));
      return;
    }
    const name = `${this.topic.replace(/^\//, '').replaceAll('/', '_')}.png`;
    this.canvas.toBlob((blob) => {
      if (blob) download(name, blob);
    });
  }
}
