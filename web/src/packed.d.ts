declare module '*.wasm?packed' {
  /** The file, compressed by gzip, as base64. */
  const packed: string;
  export default packed;
}
