/** Dragging a field of a message from one panel to another. */

/** The type under which a dragged field travels: `/odom/pose/pose/position/x`. */
export const FIELD_MIME = 'application/x-gazelle-field';

/** Gives a drag the field's path. */
export function carryField(event: DragEvent, path: string): void {
  if (!event.dataTransfer) return;
  event.dataTransfer.setData(FIELD_MIME, path);
  event.dataTransfer.setData('text/plain', path);
  event.dataTransfer.effectAllowed = 'copy';
}

/** Takes dragged fields on an element; `mark` shows where they may be dropped. */
export function acceptFields(
  element: HTMLElement,
  mark: HTMLElement,
  take: (path: string) => void,
): void {
  element.addEventListener('dragover', (event) => {
    if (!event.dataTransfer?.types.includes(FIELD_MIME)) return;
    event.preventDefault();
    event.stopPropagation();
    mark.classList.add('dropping');
  });
  element.addEventListener('dragleave', () => mark.classList.remove('dropping'));
  element.addEventListener('drop', (event) => {
    mark.classList.remove('dropping');
    const path = event.dataTransfer?.getData(FIELD_MIME);
    if (!path) return;
    event.preventDefault();
    event.stopPropagation();
    take(path);
  });
}
