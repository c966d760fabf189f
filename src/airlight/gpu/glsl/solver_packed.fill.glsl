#version 300 es
// of solver_packed.wgsl e13a679bd89651f8, by naga-wasm@30.1.0
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

layout(location = 0) out vec4 _fs2p_location0;

ivec2 texel_place(int index) {
    return ivec2((index & 2047), (index >> 11u));
}

vec4 read_fine_table(int index_1) {
    ivec2 _e2 = texel_place(index_1);
    vec4 _e4 = texelFetch(_group_0_binding_3_fs, _e2, 0);
    return _e4;
}

vec4 read_scales_table(int index_2) {
    ivec2 _e2 = texel_place(index_2);
    vec4 _e4 = texelFetch(_group_0_binding_4_fs, _e2, 0);
    return _e4;
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
    float value = (((quarter & 1) == 1) ? _e9 : _e8);
    return ((quarter >= 2) ? -(value) : value);
}

float cosine(float x_6) {
    bool local_2 = false;
    float turns_2 = roundEven((x_6 * 0.63661975));
    float _e4 = rest_of_quarter(x_6, turns_2);
    int quarter_1 = (int(turns_2) & 3);
    float _e8 = cosine_of_quarter(_e4);
    float _e9 = sine_of_quarter(_e4);
    float value_1 = (((quarter_1 & 1) == 1) ? _e9 : _e8);
    if (!((quarter_1 == 1))) {
        local_2 = (quarter_1 == 2);
    } else {
        local_2 = true;
    }
    bool _e24 = local_2;
    return (_e24 ? -(value_1) : value_1);
}

float angle_of(float y, float x_7) {
    float a_2 = abs(x_7);
    float b_2 = abs(y);
    float slope = (min(a_2, b_2) / max(max(a_2, b_2), 1e-37));
    bool steep = (slope > 0.41421357);
    float t = (steep ? ((slope - 1.0) / (slope + 1.0)) : slope);
    float z = (t * t);
    float tail_1 = (-0.3333295 + (z * (0.19977711 + (z * (-0.13877685 + (z * 0.080537446))))));
    float part_1 = ((steep ? 0.7853982 : 0.0) + (t + ((t * z) * tail_1)));
    float quarter_2 = ((b_2 > a_2) ? (1.5707964 - part_1) : part_1);
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

vec4 packed_(int index_3) {
    int nodes = 0;
    int moments = 0;
    int node = 0;
    vec4 scale = vec4(0.0);
    int part = 0;
    float _e9 = _group_0_binding_0_fs.most_counts.x;
    float _e14 = _group_0_binding_0_fs.counts.z;
    nodes = (int(_e9) * int(_e14));
    int _e17 = nodes;
    float _e21 = _group_0_binding_0_fs.more_counts.y;
    moments = (_e17 * (1 + int(_e21)));
    int _e26 = moments;
    if ((index_3 >= _e26)) {
        int _e28 = moments;
        int _e31 = whole_quotient((index_3 - _e28), 2);
        node = _e31;
        int _e32 = nodes;
        int _e33 = node;
        vec4 _e37 = read_scales_table((1 * (_e32 + _e33)));
        scale = _e37;
        int _e38 = moments;
        int _e41 = whole_rest((index_3 - _e38), 2);
        if ((_e41 == 0)) {
            vec4 _e44 = scale;
            return _e44;
        }
        int _e45 = nodes;
        float _e49 = _group_0_binding_0_fs.more_counts.y;
        int _e52 = node;
        vec4 _e56 = read_fine_table((1 * ((_e45 * int(_e49)) + _e52)));
        vec4 _e57 = scale;
        return (_e56 * _e57);
    }
    float _e62 = _group_0_binding_0_fs.more_counts.y;
    int _e66 = whole_quotient(index_3, (1 + int(_e62)));
    float _e70 = _group_0_binding_0_fs.more_counts.y;
    int _e74 = whole_rest(index_3, (1 + int(_e70)));
    node = _e66;
    part = _e74;
    int _e75 = node;
    vec4 _e78 = read_scales_table((1 * _e75));
    scale = _e78;
    int _e79 = part;
    if ((_e79 == 0)) {
        vec4 _e82 = scale;
        return _e82;
    }
    int _e83 = node;
    float _e87 = _group_0_binding_0_fs.more_counts.y;
    int _e90 = part;
    vec4 _e96 = read_fine_table((1 * (((_e83 * int(_e87)) + _e90) - 1)));
    vec4 _e97 = scale;
    return (_e96 * _e97);
}

vec4 texel(int index_4) {
    vec4 _e1 = packed_(index_4);
    return _e1;
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_5 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_5, first), last));
    if (!((index_5 < first))) {
        local = (index_5 > last);
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
