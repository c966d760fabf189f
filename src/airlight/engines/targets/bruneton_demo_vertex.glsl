#version 330
uniform mat4 model_from_view;
uniform mat4 view_from_clip;
layout(location = 0) in vec4 vertex;
out vec3 view_ray;

void main() {
  vec4 ahead = view_from_clip * vertex;
  view_ray = (model_from_view * vec4(ahead.xyz, 0.0)).xyz;
  gl_Position = vertex;
}
