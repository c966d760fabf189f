#version 300 es
// of two_targets.wgsl 9f35ac246e0dd97c, by naga-wasm@30.1.0
precision highp float;
precision highp int;

struct Uniforms {
    vec4 counts;
    vec4 colors[4];
};
struct Pair {
    float v0_;
    float v1_;
};
struct Targets {
    vec4 light;
    vec4 place;
};
const float STEPS[4] = float[4](1.0, 2.0, 4.0, 8.0);


Pair doubled(float x) {
    return Pair(x, (2.0 * x));
}

void main() {
    uint k = uint(gl_VertexID);
    gl_Position = vec4(((float((k & 1u)) * 4.0) - 1.0), ((float((k >> 1u)) * 4.0) - 1.0), 0.0, 1.0);
    gl_Position.yz = vec2(-gl_Position.y, gl_Position.z * 2.0 - gl_Position.w);
    return;
}
