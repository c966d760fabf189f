#version 300 es
// of solver_refined.wgsl e0bb36581c9f1489, by naga-wasm@30.1.0
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
struct Several_f32_f32_f32_f32_ {
    float v0_;
    float v1_;
    float v2_;
    float v3_;
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

float read_light_table(int index_2) {
    ivec2 _e4 = texel_place((index_2 >> 2u));
    vec4 _e6 = texelFetch(_group_0_binding_3_fs, _e4, 0);
    return _e6[(index_2 & 3)];
}

float read_floors_table(int index_3) {
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
    float y_3 = (x_2 * x_2);
    return (x_2 + ((x_2 * y_3) * (-0.16666655 + (y_3 * (0.008332161 - (0.00019515296 * y_3))))));
}

float cosine_of_quarter(float x_3) {
    float y_4 = (x_3 * x_3);
    float tail = ((y_4 * y_4) * (0.041666646 + (y_4 * (-0.0013887316 + (2.4433157e-5 * y_4)))));
    return ((1.0 - (0.5 * y_4)) + tail);
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
    float value_2 = (((quarter & 1) == 1) ? _e9 : _e8);
    return ((quarter >= 2) ? -(value_2) : value_2);
}

float cosine(float x_6) {
    bool local_2 = false;
    float turns_2 = roundEven((x_6 * 0.63661975));
    float _e4 = rest_of_quarter(x_6, turns_2);
    int quarter_1 = (int(turns_2) & 3);
    float _e8 = cosine_of_quarter(_e4);
    float _e9 = sine_of_quarter(_e4);
    float value_3 = (((quarter_1 & 1) == 1) ? _e9 : _e8);
    if (!((quarter_1 == 1))) {
        local_2 = (quarter_1 == 2);
    } else {
        local_2 = true;
    }
    bool _e24 = local_2;
    return (_e24 ? -(value_3) : value_3);
}

float angle_of(float y, float x_7) {
    float a_2 = abs(x_7);
    float b_2 = abs(y);
    float slope = (min(a_2, b_2) / max(max(a_2, b_2), 1e-37));
    bool steep = (slope > 0.41421357);
    float t = (steep ? ((slope - 1.0) / (slope + 1.0)) : slope);
    float z = (t * t);
    float tail_1 = (-0.3333295 + (z * (0.19977711 + (z * (-0.13877685 + (z * 0.080537446))))));
    float part_3 = ((steep ? 0.7853982 : 0.0) + (t + ((t * z) * tail_1)));
    float quarter_2 = ((b_2 > a_2) ? (1.5707964 - part_3) : part_3);
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

float light_number(int start, int step_1_, int i, int part, float dark) {
    float value = 0.0;
    float _e8 = read_light_table((start + (i * step_1_)));
    value = _e8;
    if ((part == 0)) {
        float _e11 = value;
        return max(_e11, dark);
    }
    float _e13 = value;
    return _e13;
}

float light_number_2_(int start_1, int step_1_1, int i_1, float dark_1) {
    float value_1 = 0.0;
    float _e7 = read_light_table((start_1 + (i_1 * step_1_1)));
    value_1 = _e7;
    float _e8 = value_1;
    return max(_e8, dark_1);
}

Several_f32_f32_f32_f32_ four_levels(int start_2, int step_1_2, int i_2, float dark_2, int radii) {
    float near = 0.0;
    float far = 0.0;
    float below = 0.0;
    float above = 0.0;
    float _e9 = light_number_2_(start_2, step_1_2, i_2, dark_2);
    near = _e9;
    float _e12 = light_number_2_(start_2, step_1_2, (i_2 + 1), dark_2);
    far = _e12;
    float _e17 = light_number_2_(start_2, step_1_2, max((i_2 - 1), 0), dark_2);
    below = _e17;
    float _e23 = light_number_2_(start_2, step_1_2, min((i_2 + 2), (radii - 1)), dark_2);
    above = _e23;
    if ((i_2 == 0)) {
        float _e26 = near;
        float _e27 = far;
        float _e31 = above;
        below = ((3.0 * (_e26 - _e27)) + _e31);
    }
    if ((i_2 == (radii - 2))) {
        float _e36 = far;
        float _e37 = near;
        float _e41 = below;
        above = ((3.0 * (_e36 - _e37)) + _e41);
    }
    float _e43 = below;
    float _e44 = near;
    float _e45 = far;
    float _e46 = above;
    return Several_f32_f32_f32_f32_(_e43, _e44, _e45, _e46);
}

float cubic_bend(float x_11, float below_1, float near_1, float far_1, float above_1) {
    float y_1 = 0.0;
    y_1 = (1.0 - x_11);
    float _e8 = y_1;
    float _e12 = y_1;
    return (((x_11 * _e8) / 6.0) * (((1.0 + _e12) * (((2.0 * near_1) - below_1) - far_1)) + ((1.0 + x_11) * (((2.0 * far_1) - above_1) - near_1))));
}

bool is_smooth(float x_12, float near_2, float far_2, float bend) {
    return (abs(bend) < (0.2 * (((1.0 - x_12) * near_2) + (x_12 * far_2))));
}

Several_f32_f32_f32_f32_ four_levels_2_(int start_3, int step_1_3, int i_3, int part_1, float dark_3, int radii_1) {
    float near_3 = 0.0;
    float far_3 = 0.0;
    float below_2 = 0.0;
    float above_2 = 0.0;
    float _e10 = light_number(start_3, step_1_3, i_3, part_1, dark_3);
    near_3 = _e10;
    float _e13 = light_number(start_3, step_1_3, (i_3 + 1), part_1, dark_3);
    far_3 = _e13;
    float _e18 = light_number(start_3, step_1_3, max((i_3 - 1), 0), part_1, dark_3);
    below_2 = _e18;
    float _e24 = light_number(start_3, step_1_3, min((i_3 + 2), (radii_1 - 1)), part_1, dark_3);
    above_2 = _e24;
    if ((i_3 == 0)) {
        float _e27 = near_3;
        float _e28 = far_3;
        float _e32 = above_2;
        below_2 = ((3.0 * (_e27 - _e28)) + _e32);
    }
    if ((i_3 == (radii_1 - 2))) {
        float _e37 = far_3;
        float _e38 = near_3;
        float _e42 = below_2;
        above_2 = ((3.0 * (_e37 - _e38)) + _e42);
    }
    float _e44 = below_2;
    float _e45 = near_3;
    float _e46 = far_3;
    float _e47 = above_2;
    return Several_f32_f32_f32_f32_(_e44, _e45, _e46, _e47);
}

float between_levels(float x_13, float near_4, float far_4, float bend_1, float near_scale, float far_scale, float level) {
    float y_2 = 0.0;
    float ratio = 0.0;
    y_2 = (1.0 - x_13);
    float _e11 = y_2;
    float _e17 = y_2;
    ratio = ((((_e11 * near_4) * near_scale) + ((x_13 * far_4) * far_scale)) / ((_e17 * near_scale) + (x_13 * far_scale)));
    float _e22 = ratio;
    float _e23 = y_2;
    float _e28 = ratio;
    return (_e22 + (level * ((((_e23 * near_4) + (x_13 * far_4)) + bend_1) - _e28)));
}

float refined(int index_4) {
    int lane = 0;
    int number = 0;
    int width = 0;
    int start_4 = 0;
    float dark_4 = 0.0;
    int part_2 = 0;
    int j = 0;
    int level_1 = 0;
    int i_4 = 0;
    int step_1_4 = 0;
    int mean_at = 0;
    int here = 0;
    float x_14 = 0.0;
    float below_3 = 0.0;
    float near_5 = 0.0;
    float far_5 = 0.0;
    float above_3 = 0.0;
    float near_scale_1 = 0.0;
    float far_scale_1 = 0.0;
    bool smooth_1_ = false;
    float bend_2 = 0.0;
    float weight = 0.0;
    int _e24 = whole_rest(index_4, 4);
    lane = _e24;
    int _e26 = whole_quotient(index_4, 4);
    number = _e26;
    float _e30 = _group_0_binding_0_fs.more_counts.y;
    int now_1_ = int(_e30);
    int _e33 = lane;
    float _e34 = read_floors_table(_e33);
    width = now_1_;
    start_4 = 0;
    dark_4 = _e34;
    int _e35 = number;
    float _e39 = _group_0_binding_0_fs.most_counts.x;
    float _e44 = _group_0_binding_0_fs.counts.z;
    float _e50 = _group_0_binding_0_fs.more_counts.y;
    if ((_e35 >= ((int(_e39) * int(_e44)) * int(_e50)))) {
        int _e54 = number;
        float _e58 = _group_0_binding_0_fs.most_counts.x;
        float _e63 = _group_0_binding_0_fs.counts.z;
        float _e69 = _group_0_binding_0_fs.more_counts.y;
        number = (_e54 - ((int(_e58) * int(_e63)) * int(_e69)));
        width = 1;
        float _e77 = _group_0_binding_0_fs.counts.x;
        float _e82 = _group_0_binding_0_fs.counts.z;
        float _e88 = _group_0_binding_0_fs.more_counts.y;
        start_4 = (((int(_e77) * int(_e82)) * int(_e88)) * 4);
        int _e93 = lane;
        float _e96 = read_floors_table((4 + _e93));
        dark_4 = _e96;
    }
    int _e97 = number;
    int _e98 = width;
    int _e99 = whole_rest(_e97, _e98);
    part_2 = _e99;
    int _e100 = number;
    int _e101 = width;
    int _e102 = whole_quotient(_e100, _e101);
    float _e106 = _group_0_binding_0_fs.counts.z;
    int _e108 = whole_rest(_e102, int(_e106));
    j = _e108;
    int _e109 = number;
    int _e110 = width;
    float _e114 = _group_0_binding_0_fs.counts.z;
    int _e117 = whole_quotient(_e109, (_e110 * int(_e114)));
    level_1 = _e117;
    int _e118 = level_1;
    float _e122 = _group_0_binding_0_fs.most_counts.y;
    int _e124 = whole_quotient(_e118, int(_e122));
    i_4 = _e124;
    float _e128 = _group_0_binding_0_fs.counts.z;
    int _e130 = width;
    step_1_4 = ((int(_e128) * _e130) * 4);
    int _e134 = start_4;
    int _e135 = j;
    int _e136 = width;
    int _e141 = lane;
    mean_at = ((_e134 + ((_e135 * _e136) * 4)) + _e141);
    int _e143 = mean_at;
    int _e144 = part_2;
    here = (_e143 + (_e144 * 4));
    int _e148 = level_1;
    float _e152 = _group_0_binding_0_fs.most_counts.y;
    int _e154 = whole_rest(_e148, int(_e152));
    if ((_e154 == 0)) {
        int _e157 = here;
        int _e158 = step_1_4;
        int _e159 = i_4;
        int _e160 = part_2;
        float _e161 = dark_4;
        float _e162 = light_number(_e157, _e158, _e159, _e160, _e161);
        return _e162;
    }
    int _e163 = level_1;
    float _e167 = _group_0_binding_0_fs.most_counts.y;
    int _e169 = whole_rest(_e163, int(_e167));
    float _e174 = _group_0_binding_0_fs.most_counts.y;
    x_14 = (float(_e169) / float(int(_e174)));
    int _e178 = mean_at;
    int _e179 = step_1_4;
    int _e180 = i_4;
    float _e181 = dark_4;
    float _e185 = _group_0_binding_0_fs.counts.x;
    Several_f32_f32_f32_f32_ _e187 = four_levels(_e178, _e179, _e180, _e181, int(_e185));
    below_3 = _e187.v0_;
    near_5 = _e187.v1_;
    far_5 = _e187.v2_;
    above_3 = _e187.v3_;
    float _e192 = near_5;
    float now_5_ = (1.0 / sqrt(_e192));
    float _e196 = far_5;
    float now_6_ = (1.0 / sqrt(_e196));
    near_scale_1 = now_5_;
    far_scale_1 = now_6_;
    float _e200 = x_14;
    float _e201 = near_5;
    float _e202 = far_5;
    float _e203 = x_14;
    float _e204 = below_3;
    float _e205 = near_5;
    float _e206 = far_5;
    float _e207 = above_3;
    float _e208 = cubic_bend(_e203, _e204, _e205, _e206, _e207);
    bool _e209 = is_smooth(_e200, _e201, _e202, _e208);
    smooth_1_ = _e209;
    int _e210 = here;
    int _e211 = step_1_4;
    int _e212 = i_4;
    int _e213 = part_2;
    float _e214 = dark_4;
    float _e218 = _group_0_binding_0_fs.counts.x;
    Several_f32_f32_f32_f32_ _e220 = four_levels_2_(_e210, _e211, _e212, _e213, _e214, int(_e218));
    below_3 = _e220.v0_;
    near_5 = _e220.v1_;
    far_5 = _e220.v2_;
    above_3 = _e220.v3_;
    float _e225 = x_14;
    float _e226 = below_3;
    float _e227 = near_5;
    float _e228 = far_5;
    float _e229 = above_3;
    float _e230 = cubic_bend(_e225, _e226, _e227, _e228, _e229);
    bend_2 = _e230;
    bool _e231 = smooth_1_;
    if (!(_e231)) {
        bend_2 = 0.0;
    }
    int _e234 = j;
    int _e237 = lane;
    float _e239 = read_level(((_e234 * 4) + _e237));
    weight = _e239;
    float _e240 = x_14;
    float _e241 = near_5;
    float _e242 = far_5;
    float _e243 = bend_2;
    float _e244 = near_scale_1;
    float _e245 = far_scale_1;
    float _e246 = weight;
    float _e247 = between_levels(_e240, _e241, _e242, _e243, _e244, _e245, _e246);
    return _e247;
}

vec4 texel(int index_5) {
    float _e5 = refined(((4 * index_5) + 0));
    float _e10 = refined(((4 * index_5) + 1));
    float _e15 = refined(((4 * index_5) + 2));
    float _e20 = refined(((4 * index_5) + 3));
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
