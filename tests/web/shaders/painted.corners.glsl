#version 300 es
// of painted.wgsl 3d65f4f0289b678c, by naga-wasm@30.1.0
precision highp float;
precision highp int;

struct Uniforms {
    vec4 camera_right;
    vec4 camera_up;
    vec4 camera_forward;
    vec4 frame;
    vec4 display;
    vec4 paint;
};

void main() {
    uint k = uint(gl_VertexID);
    gl_Position = vec4(((float((k & 1u)) * 4.0) - 1.0), ((float((k >> 1u)) * 4.0) - 1.0), 0.0, 1.0);
    gl_Position.yz = vec2(-gl_Position.y, gl_Position.z * 2.0 - gl_Position.w);
    return;
}
