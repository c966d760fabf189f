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

void fill(inout float room_1[16], int count) {
    int i = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e17 = i;
            i = (_e17 + 1);
        }
        loop_init = false;
        int _e4 = i;
        if ((_e4 < count)) {
        } else {
            break;
        }
        {
            int _e6 = i;
            int _e9 = i;
            int _e13 = i;
            room_1[_e6] = (STEPS[(_e9 & 3)] * float(_e13));
        }
    }
    return;
}

void fill_through(inout float room_2[16], int count_1) {
    fill(room_2, count_1);
    if ((count_1 > 3)) {
        room_2[0] = 0.5;
        return;
    }
    room_2[1] = 0.25;
    return;
}

void main() {
    uint k = uint(gl_VertexID);
    gl_Position = vec4(((float((k & 1u)) * 4.0) - 1.0), ((float((k >> 1u)) * 4.0) - 1.0), 0.0, 1.0);
    gl_Position.yz = vec2(-gl_Position.y, gl_Position.z * 2.0 - gl_Position.w);
    return;
}
