#version 300 es
// of full_screen_triangle.wgsl 9c12498fe1e014be, by naga-wasm@30.1.0
precision highp float;
precision highp int;


void main() {
    uint index = uint(gl_VertexID);
    float x = ((index == 1u) ? 3.0 : -1.0);
    float y = ((index == 2u) ? 3.0 : -1.0);
    gl_Position = vec4(x, y, 0.0, 1.0);
    gl_Position.yz = vec2(-gl_Position.y, gl_Position.z * 2.0 - gl_Position.w);
    return;
}
