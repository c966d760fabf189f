// Fills the texels of a flat texture whose numbers lie in a span; texel(index) is emitted.
@fragment
fn fill(@builtin(position) position: vec4f) -> @location(0) vec4f {
  let index = i32(position.y) * 2048 + i32(position.x);
  let first = i32(span.texels.x);
  let last = i32(span.texels.y) - 1;
  // Discarded invocations may go on: they must not follow rays that are not there.
  let value = texel(clamp(index, first, last));
  if (index < first || index > last) {
    discard;
  }
  return value;
}
