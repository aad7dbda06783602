// A canvas in the pixels of the screen: keeps `owner`'s width, height (CSS pixels) and ratio with its canvas.
export function fitCanvas(owner) {
  const { canvas } = owner, { clientWidth, clientHeight } = canvas, ratio = devicePixelRatio || 1;
  Object.assign(owner, { width: clientWidth, height: clientHeight, ratio });
  const width = Math.round(clientWidth * ratio), height = Math.round(clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
}
