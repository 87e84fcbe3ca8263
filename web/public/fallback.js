// Where a page may not load modules (a sandboxed frame on a host without CORS headers, or a page opened from a folder
// without a server), the same code comes as one classic script.
{
  const { src, dataset } = document.currentScript;
  document.addEventListener('DOMContentLoaded', () => {
    if ('started' in document.documentElement.dataset) return; // modules run before this
    const script = document.createElement('script');
    script.src = src.replace('fallback.js', 'pillow-mesh.standalone.js');
    script.onload = () => globalThis.PillowMesh[dataset.start]?.();
    document.head.append(script);
  });
}
