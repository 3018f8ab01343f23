/** Styles are imported for their effect alone. */
declare module '*.css';

/** Styles as text, for a page that has no other file. */
declare module '*.css?inline' {
  const text: string;
  export default text;
}
