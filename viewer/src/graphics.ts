let slowly: boolean | null = null;

/**
 * Whether the processor renders instead of graphics hardware: edges are not smoothed then, which takes
 * most of its time. The address PAGE.html#fine smooths them all the same, for pictures.
 */
export function paintsSlowly(): boolean {
  if (slowly !== null) return slowly;
  slowly = false;
  if (location.hash === '#fine') return slowly;
  const context = document.createElement('canvas').getContext('webgl2');
  const name = context?.getExtension('WEBGL_debug_renderer_info');
  if (context && name) {
    const renderer = String(context.getParameter(name.UNMASKED_RENDERER_WEBGL));
    slowly = /swiftshader|llvmpipe|softpipe|software/i.test(renderer);
    context.getExtension('WEBGL_lose_context')?.loseContext();
  }
  return slowly;
}
