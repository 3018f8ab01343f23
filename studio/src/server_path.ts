/** A path of the server as this page reaches it, which may lie in a folder there. */
export function serverPath(path: string, place: Location = location): string {
  return place.pathname.replace(/[^/]*$/, '') + path.slice(1);
}
