/** A small window in the view that shows pictures: Image and Camera. */
import { bytes, type Frame } from '../binary_frame';
import { h, setText } from '../widgets/dom';
import type { View } from '../scene/view';

/** A box with a title, in the lower left corner of a view; it can be dragged and resized. */
export class PictureBox {
  readonly canvas = h('canvas', { class: 'picture-canvas' });
  readonly element: HTMLElement;
  pictures = 0;
  private readonly caption = h('figcaption', { class: 'picture-caption' });

  constructor(
    private readonly view: View,
    title: string,
  ) {
    this.element = h(
      'figure',
      { class: 'picture', 'aria-label': title },
      this.caption,
      this.canvas,
    );
    this.setTitle(title);
    const shelf =
      view.host.querySelector('.picture-shelf') ??
      view.host.appendChild(h('div', { class: 'picture-shelf' }));
    shelf.append(this.element);
    this.element.hidden = true;
  }

  setTitle(title: string): void {
    setText(this.caption, title);
    this.element.setAttribute('aria-label', title);
  }

  /** Decode a JPEG frame; resolves when it can be drawn. */
  decode(frame: Frame): Promise<ImageBitmap> {
    return createImageBitmap(new Blob([bytes(frame)], { type: 'image/jpeg' }));
  }

  /** Show a decoded picture and free it. */
  show(picture: ImageBitmap): void {
    this.element.hidden = false;
    if (this.canvas.width !== picture.width || this.canvas.height !== picture.height) {
      this.canvas.width = picture.width;
      this.canvas.height = picture.height;
    }
    this.canvas.getContext('2d')?.drawImage(picture, 0, 0);
    picture.close();
    this.pictures += 1;
  }

  hide(hidden: boolean): void {
    this.element.hidden = hidden || !this.pictures;
  }

  /** Where the canvas is in the view, CSS pixels from the lower left corner. */
  place(): { x: number; y: number; width: number; height: number } {
    const outer = this.view.canvas.getBoundingClientRect();
    const inner = this.canvas.getBoundingClientRect();
    return {
      x: inner.left - outer.left,
      y: outer.bottom - inner.bottom,
      width: inner.width,
      height: inner.height,
    };
  }

  dispose(): void {
    this.element.remove();
  }
}
