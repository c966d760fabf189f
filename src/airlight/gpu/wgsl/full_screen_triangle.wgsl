// One triangle that covers the target: its corners are (-1, -1), (3, -1), (-1, 3).
@vertex
fn full_screen_triangle(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  let x = select(-1.0, 3.0, index == 1u);
  let y = select(-1.0, 3.0, index == 2u);
  return vec4f(x, y, 0.0, 1.0);
}
