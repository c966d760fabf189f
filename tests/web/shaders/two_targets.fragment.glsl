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

layout(std140) uniform Uniforms_block_0Fragment { Uniforms _group_0_binding_0_fs; };

uniform highp sampler2D _group_0_binding_1_fs;

uniform highp sampler2D _group_0_binding_2_fs;

uniform highp sampler2D _group_1_binding_0_fs;

vec4 kept[8];

float fragment_room[16];

layout(location = 0) out vec4 _fs2p_location0;
layout(location = 1) out vec4 _fs2p_location1;

float scalar(int index) {
    vec4 _e8 = texelFetch(_group_0_binding_1_fs, ivec2((index & 2047), (index >> 11u)), 0);
    return _e8.x;
}

Pair doubled(float x) {
    return Pair(x, (2.0 * x));
}

void fill_1_(int count) {
    int i = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e17 = i;
            i = (_e17 + 1);
        }
        loop_init = false;
        int _e3 = i;
        if ((_e3 < count)) {
        } else {
            break;
        }
        {
            int _e6 = i;
            int _e9 = i;
            int _e13 = i;
            fragment_room[_e6] = (STEPS[(_e9 & 3)] * float(_e13));
        }
    }
    return;
}

void fill_through_1_(int count_1) {
    fill_1_(count_1);
    if ((count_1 > 3)) {
        fragment_room[0] = 0.5;
        return;
    }
    fragment_room[1] = 0.25;
    return;
}

void main() {
    vec4 at = gl_FragCoord;
    float sum = 0.0;
    int k_1 = 0;
    float _e4 = _group_0_binding_0_fs.counts.x;
    int count_2 = int(_e4);
    float _e11 = _group_0_binding_0_fs.counts.y;
    int index_1 = ((int(at.y) * int(_e11)) + int(at.x));
    fill_through_1_(count_2);
    while(true) {
        int _e21 = k_1;
        if ((_e21 < count_2)) {
        } else {
            break;
        }
        {
            int _e23 = k_1;
            k_1 = (_e23 + 1);
            int _e26 = k_1;
            if ((_e26 == 3)) {
                continue;
            }
            float _e29 = sum;
            int _e31 = k_1;
            float _e35 = fragment_room[(_e31 - 1)];
            sum = (_e29 + _e35);
        }
    }
    int _e38 = k_1;
    vec4 _e49 = texelFetch(_group_1_binding_0_fs, ivec2((index_1 & 2047), (index_1 >> 11u)), 0);
    kept[(_e38 & 7)] = _e49;
    float _e52 = scalar((index_1 + 2040));
    Pair _e53 = doubled(_e52);
    float chosen = (((index_1 & 1) == 1) ? _e53.v1_ : _e53.v0_);
    vec4 spectrum = texelFetch(_group_0_binding_2_fs, ivec2((index_1 & 2047), (index_1 >> 11u)), 0);
    vec4 _e74 = _group_0_binding_0_fs.colors[(index_1 & 3)];
    int _e77 = k_1;
    vec4 _e81 = kept[(_e77 & 7)];
    float _e82 = sum;
    vec4 light = ((_e74 * spectrum) + (_e81 * _e82));
    float _e86 = sum;
    Targets _tmp_return = Targets(light, vec4(float(index_1), chosen, _e86, at.y));
    _fs2p_location0 = _tmp_return.light;
    _fs2p_location1 = _tmp_return.place;
    return;
}
