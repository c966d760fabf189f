#version 300 es
// of solver_node_scale.wgsl 257fe606fa958650, by naga-wasm@30.1.0
precision highp float;
precision highp int;

struct Solve {
    vec4 counts;
    vec4 more_counts;
    vec4 most_counts;
    vec4 measures;
    vec4 mu_shape;
    vec4 mu_start;
    vec4 weight_shape;
    vec4 weight_start;
    vec4 flux_shape;
    vec4 flux_start;
    vec4 start_shape;
    vec4 start_start;
    vec4 total_shape;
    vec4 total_start;
    vec4 end_shape;
    vec4 end_start;
    vec4 radius_shape;
    vec4 radius_start;
    vec4 mu_along_shape;
    vec4 mu_along_start;
    vec4 turn_shape;
    vec4 turn_start;
    vec4 amount_shape;
    vec4 amount_start;
    vec4 column_shape;
    vec4 column_start;
    vec4 sun_cosines_shape;
    vec4 sun_cosines_start;
    vec4 row_shape;
    vec4 row_start;
    vec4 place_shape;
    vec4 place_start;
    vec4 cosines_shape;
    vec4 cosines_start;
    vec4 multiples_shape;
    vec4 multiples_start;
    vec4 harmonic_shape;
    vec4 harmonic_start;
    vec4 ahead_shape;
    vec4 ahead_start;
    vec4 back_shape;
    vec4 back_start;
    vec4 ratios_shape;
    vec4 ratios_start;
    vec4 lift_shape;
    vec4 lift_start;
    vec4 level_shape;
    vec4 level_start;
    vec4 extinction_shape;
    vec4 extinction_start;
    vec4 moments_shape;
    vec4 moments_start;
    vec4 albedo_shape;
    vec4 albedo_start;
};
struct Span {
    vec4 texels;
};
layout(std140) uniform Solve_block_0Fragment { Solve _group_0_binding_0_fs; };

layout(std140) uniform Span_block_1Fragment { Span _group_0_binding_1_fs; };

uniform highp sampler2D _group_0_binding_3_fs;

uniform highp sampler2D _group_0_binding_4_fs;

uniform highp sampler2D _group_0_binding_5_fs;

layout(location = 0) out vec4 _fs2p_location0;

ivec2 texel_place(int index) {
    return ivec2((index & 2047), (index >> 11u));
}

float read_level(int index_1) {
    float _e5 = _group_0_binding_0_fs.level_start.x;
    ivec2 _e8 = texel_place((index_1 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_5_fs, _e8, 0);
    return _e10.x;
}

int size_level(int axis) {
    float _e4 = _group_0_binding_0_fs.level_shape[axis];
    return int(_e4);
}

float read_fine_table(int index_2) {
    ivec2 _e4 = texel_place((index_2 >> 2u));
    vec4 _e6 = texelFetch(_group_0_binding_3_fs, _e4, 0);
    return _e6[(index_2 & 3)];
}

float read_heights_table(int index_3) {
    ivec2 _e4 = texel_place((index_3 >> 2u));
    vec4 _e6 = texelFetch(_group_0_binding_4_fs, _e4, 0);
    return _e6[(index_3 & 3)];
}

float squared(float x) {
    return (x * x);
}

float cubed(float x_1) {
    return ((x_1 * x_1) * x_1);
}

int whole_quotient(int a, int b) {
    bool local_1 = false;
    int towards_zero = (a / b);
    if (((towards_zero * b) != a)) {
        local_1 = ((a < 0) != (b < 0));
    } else {
        local_1 = false;
    }
    bool _e15 = local_1;
    return (_e15 ? (towards_zero - 1) : towards_zero);
}

int whole_rest(int a_1, int b_1) {
    int _e2 = whole_quotient(a_1, b_1);
    return (a_1 - (b_1 * _e2));
}

float sine_of_quarter(float x_2) {
    float y_1 = (x_2 * x_2);
    return (x_2 + ((x_2 * y_1) * (-0.16666655 + (y_1 * (0.008332161 - (0.00019515296 * y_1))))));
}

float cosine_of_quarter(float x_3) {
    float y_2 = (x_3 * x_3);
    float tail = ((y_2 * y_2) * (0.041666646 + (y_2 * (-0.0013887316 + (2.4433157e-5 * y_2)))));
    return ((1.0 - (0.5 * y_2)) + tail);
}

float rest_of_quarter(float x_4, float turns) {
    return (((x_4 - (turns * 1.5703125)) - (turns * 0.0004837513)) - (turns * 7.54979e-8));
}

float sine(float x_5) {
    float turns_1 = roundEven((x_5 * 0.63661975));
    float _e4 = rest_of_quarter(x_5, turns_1);
    int quarter = (int(turns_1) & 3);
    float _e8 = sine_of_quarter(_e4);
    float _e9 = cosine_of_quarter(_e4);
    float value_1 = (((quarter & 1) == 1) ? _e9 : _e8);
    return ((quarter >= 2) ? -(value_1) : value_1);
}

float cosine(float x_6) {
    bool local_2 = false;
    float turns_2 = roundEven((x_6 * 0.63661975));
    float _e4 = rest_of_quarter(x_6, turns_2);
    int quarter_1 = (int(turns_2) & 3);
    float _e8 = cosine_of_quarter(_e4);
    float _e9 = sine_of_quarter(_e4);
    float value_2 = (((quarter_1 & 1) == 1) ? _e9 : _e8);
    if (!((quarter_1 == 1))) {
        local_2 = (quarter_1 == 2);
    } else {
        local_2 = true;
    }
    bool _e24 = local_2;
    return (_e24 ? -(value_2) : value_2);
}

float angle_of(float y, float x_7) {
    float a_2 = abs(x_7);
    float b_2 = abs(y);
    float slope = (min(a_2, b_2) / max(max(a_2, b_2), 1e-37));
    bool steep = (slope > 0.41421357);
    float t = (steep ? ((slope - 1.0) / (slope + 1.0)) : slope);
    float z = (t * t);
    float tail_1 = (-0.3333295 + (z * (0.19977711 + (z * (-0.13877685 + (z * 0.080537446))))));
    float part = ((steep ? 0.7853982 : 0.0) + (t + ((t * z) * tail_1)));
    float quarter_2 = ((b_2 > a_2) ? (1.5707964 - part) : part);
    float half_ = ((x_7 < 0.0) ? (3.1415927 - quarter_2) : quarter_2);
    return ((y < 0.0) ? -(half_) : half_);
}

float arc_tangent(float x_8) {
    float _e2 = angle_of(x_8, 1.0);
    return _e2;
}

float arc_cosine(float x_9) {
    float _e9 = angle_of(sqrt(max(((1.0 - x_9) * (1.0 + x_9)), 0.0)), x_9);
    return _e9;
}

float arc_sine(float x_10) {
    float _e9 = angle_of(x_10, sqrt(max(((1.0 - x_10) * (1.0 + x_10)), 0.0)));
    return _e9;
}

float ratio_scale(float mean, float highest, float level) {
    return (1.0 / sqrt((mean * pow((highest / mean), level))));
}

float node_scale(int index_4) {
    int lane = 0;
    int node = 0;
    int nodes = 0;
    float received = 0.0;
    int j = 0;
    float value = 0.0;
    float above = 0.0;
    int _e9 = whole_rest(index_4, 4);
    lane = _e9;
    int _e11 = whole_quotient(index_4, 4);
    node = _e11;
    float _e15 = _group_0_binding_0_fs.most_counts.x;
    float _e20 = _group_0_binding_0_fs.counts.z;
    nodes = (int(_e15) * int(_e20));
    int _e23 = node;
    int _e24 = nodes;
    if ((_e23 >= _e24)) {
        int _e26 = nodes;
        float _e30 = _group_0_binding_0_fs.more_counts.y;
        int _e33 = node;
        int _e35 = nodes;
        int _e39 = lane;
        float _e41 = read_fine_table((((((_e26 * int(_e30)) + _e33) - _e35) * 4) + _e39));
        received = _e41;
        float _e42 = received;
        float _e43 = received;
        float _e45 = ratio_scale(_e42, _e43, 0.0);
        return _e45;
    }
    int _e46 = node;
    float _e50 = _group_0_binding_0_fs.counts.z;
    int _e52 = whole_rest(_e46, int(_e50));
    j = _e52;
    int _e53 = node;
    float _e57 = _group_0_binding_0_fs.more_counts.y;
    int _e62 = lane;
    float _e64 = read_fine_table((((_e53 * int(_e57)) * 4) + _e62));
    value = _e64;
    int _e65 = j;
    int _e68 = lane;
    float _e70 = read_heights_table(((_e65 * 4) + _e68));
    float _e71 = value;
    above = max(_e70, _e71);
    float _e73 = value;
    float _e74 = above;
    int _e75 = j;
    int _e78 = lane;
    float _e80 = read_level(((_e75 * 4) + _e78));
    float _e81 = ratio_scale(_e73, _e74, _e80);
    return _e81;
}

vec4 texel(int index_5) {
    float _e5 = node_scale(((4 * index_5) + 0));
    float _e10 = node_scale(((4 * index_5) + 1));
    float _e15 = node_scale(((4 * index_5) + 2));
    float _e20 = node_scale(((4 * index_5) + 3));
    return vec4(_e5, _e10, _e15, _e20);
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_6 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_6, first), last));
    if (!((index_6 < first))) {
        local = (index_6 > last);
    } else {
        local = true;
    }
    bool _e28 = local;
    if (_e28) {
        discard;
    }
    _fs2p_location0 = _e21;
    return;
}
