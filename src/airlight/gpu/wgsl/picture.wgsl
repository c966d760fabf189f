// A pixel: linear light, or what a display shows of it.

fn light_of(at: vec4f) -> vec3f {
  var found: array<vec4f, 1>;
  light_of_pixel(at.x, at.y + frame.display.w, &found);
  return vec3f(dot(found[0], frame.red), dot(found[0], frame.green), dot(found[0], frame.blue));
}

@fragment
fn linear_picture(@builtin(position) at: vec4f) -> @location(0) vec4f {
  return vec4f(light_of(at), 1.0);
}

@fragment
fn shown_picture(@builtin(position) at: vec4f) -> @location(0) vec4f {
  let light = light_of(at);
  let shown = displayed(light.x, light.y, light.z);
  return vec4f(shown.v0, shown.v1, shown.v2, 1.0);
}
