/** Pictures of the scene's tools, 16 pixels, in the colour of the text. */
import { s } from '../widgets/dom';

const PATHS = {
  camera:
    'M8 2v12M2 8h12M8 2l-1.6 1.8M8 2l1.6 1.8M8 14l-1.6-1.8M8 14l1.6-1.8M2 8l1.8-1.6M2 8l1.8 1.6M14 8l-1.8-1.6M14 8l-1.8 1.6',
  select: 'M4 2.5l8 5-3.6.8L11 13l-1.8.9-2.4-4.6L4 11.8z',
  translate:
    'M3 13V4M3 4L1.6 6M3 4l1.4 2M3 13h9M12 13l-2-1.4M12 13l-2 1.4M3 13l6-6M9 7L8.6 9M9 7L7 7.4',
  rotate: 'M12.8 6A5.2 5.2 0 1 0 13.2 9M13.4 3v3.2h-3.2',
  measure: 'M2 11l9-9 3 3-9 9zM5 8l1.5 1.5M7 6l1.5 1.5M9 4l1.5 1.5',
  interact:
    'M5 8.5V4a1 1 0 0 1 2 0v3.5V3a1 1 0 0 1 2 0v4.5V4a1 1 0 0 1 2 0v5.5c0 3-1.4 4.5-3.6 4.5S4.6 12.6 3 9.4a1 1 0 0 1 1.7-.9z',
  focus: 'M8 5.2a2.8 2.8 0 1 0 .01 0zM8 1.5v2.2M8 12.3v2.2M1.5 8h2.2M12.3 8h2.2',
  box: 'M8 1.8l5.5 3v6.4L8 14.2l-5.5-3V4.8zM2.5 4.8L8 7.8l5.5-3M8 7.8v6.4',
  sphere: 'M8 2a6 6 0 1 0 .01 0zM2 8c2 2.2 10 2.2 12 0',
  cylinder: 'M3 4c0-2.6 10-2.6 10 0v8c0 2.6-10 2.6-10 0zM3 4c0 2.6 10 2.6 10 0',
  angle: 'M8 1.8l5.5 3v6.4L8 14.2l-5.5-3V4.8zM8 7.8l5.5-3M8 7.8L2.5 4.8M8 7.8v6.4',
  picture: 'M2 5h3l1-1.6h4L11 5h3v8H2zM8 6.6a2.2 2.2 0 1 0 .01 0z',
  video: 'M2 4.5h8v7H2zM10 7l4-2v6l-4-2z',
} as const;

export type SceneIcon = keyof typeof PATHS;

/** One of the pictures. */
export function sceneIcon(name: SceneIcon): SVGSVGElement {
  const path = s('path', {
    d: PATHS[name],
    fill: 'none',
    stroke: 'currentColor',
    'stroke-width': 1.3,
    'stroke-linecap': 'round',
    'stroke-linejoin': 'round',
  });
  return s(
    'svg',
    { class: 'icon', viewBox: '0 0 16 16', width: 16, height: 16, 'aria-hidden': 'true' },
    path,
  );
}
