#version 300 es
// of solver_radiance_once.wgsl 517f099e4e3ee59e, by naga-wasm@30.1.0
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
struct Several_i32_i32_i32_f32_f32_ {
    int v0_;
    int v1_;
    int v2_;
    float v3_;
    float v4_;
};
struct Several_f32_f32_ {
    float v0_;
    float v1_;
};
struct Several_f32_f32_f32_ {
    float v0_;
    float v1_;
    float v2_;
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

uniform highp sampler2D _group_0_binding_6_fs;

uniform highp sampler2D _group_0_binding_7_fs;

uniform highp sampler2D _group_0_binding_8_fs;

vec4 radiance_once_phases[8];

layout(location = 0) out vec4 _fs2p_location0;

ivec2 texel_place(int index) {
    return ivec2((index & 2047), (index >> 11u));
}

float read_mu(int index_1) {
    float _e5 = _group_0_binding_0_fs.mu_start.x;
    ivec2 _e8 = texel_place((index_1 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_mu(int axis) {
    float _e4 = _group_0_binding_0_fs.mu_shape[axis];
    return int(_e4);
}

float read_start(int index_2) {
    float _e5 = _group_0_binding_0_fs.start_start.x;
    ivec2 _e8 = texel_place((index_2 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_start(int axis_1) {
    float _e4 = _group_0_binding_0_fs.start_shape[axis_1];
    return int(_e4);
}

float read_end(int index_3) {
    float _e5 = _group_0_binding_0_fs.end_start.x;
    ivec2 _e8 = texel_place((index_3 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_end(int axis_2) {
    float _e4 = _group_0_binding_0_fs.end_shape[axis_2];
    return int(_e4);
}

float read_radius(int index_4) {
    float _e5 = _group_0_binding_0_fs.radius_start.x;
    ivec2 _e8 = texel_place((index_4 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_radius(int axis_3) {
    float _e4 = _group_0_binding_0_fs.radius_shape[axis_3];
    return int(_e4);
}

float read_turn(int index_5) {
    float _e5 = _group_0_binding_0_fs.turn_start.x;
    ivec2 _e8 = texel_place((index_5 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_turn(int axis_4) {
    float _e4 = _group_0_binding_0_fs.turn_shape[axis_4];
    return int(_e4);
}

float read_sun_cosines(int index_6) {
    float _e5 = _group_0_binding_0_fs.sun_cosines_start.x;
    ivec2 _e8 = texel_place((index_6 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_sun_cosines(int axis_5) {
    float _e4 = _group_0_binding_0_fs.sun_cosines_shape[axis_5];
    return int(_e4);
}

float read_row(int index_7) {
    float _e5 = _group_0_binding_0_fs.row_start.x;
    ivec2 _e8 = texel_place((index_7 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_row(int axis_6) {
    float _e4 = _group_0_binding_0_fs.row_shape[axis_6];
    return int(_e4);
}

float read_cosines(int index_8) {
    float _e5 = _group_0_binding_0_fs.cosines_start.x;
    ivec2 _e8 = texel_place((index_8 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_cosines(int axis_7) {
    float _e4 = _group_0_binding_0_fs.cosines_shape[axis_7];
    return int(_e4);
}

float read_lift(int index_9) {
    float _e5 = _group_0_binding_0_fs.lift_start.x;
    ivec2 _e8 = texel_place((index_9 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_lift(int axis_8) {
    float _e4 = _group_0_binding_0_fs.lift_shape[axis_8];
    return int(_e4);
}

vec4 read_moments(int index_10) {
    float _e5 = _group_0_binding_0_fs.moments_start.x;
    ivec2 _e8 = texel_place((index_10 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_8_fs, _e8, 0);
    return _e10;
}

int size_moments(int axis_9) {
    float _e4 = _group_0_binding_0_fs.moments_shape[axis_9];
    return int(_e4);
}

vec4 read_shares_table(int index_11) {
    ivec2 _e2 = texel_place(index_11);
    vec4 _e4 = texelFetch(_group_0_binding_3_fs, _e2, 0);
    return _e4;
}

vec4 read_strengths_table(int index_12) {
    ivec2 _e2 = texel_place(index_12);
    vec4 _e4 = texelFetch(_group_0_binding_4_fs, _e2, 0);
    return _e4;
}

vec4 read_reflections_table(int index_13) {
    ivec2 _e2 = texel_place(index_13);
    vec4 _e4 = texelFetch(_group_0_binding_5_fs, _e2, 0);
    return _e4;
}

vec4 read_depths_table(int index_14) {
    ivec2 _e2 = texel_place(index_14);
    vec4 _e4 = texelFetch(_group_0_binding_6_fs, _e2, 0);
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
    float a_5 = abs(x_7);
    float b_3 = abs(y);
    float slope = (min(a_5, b_3) / max(max(a_5, b_3), 1e-37));
    bool steep = (slope > 0.41421357);
    float t = (steep ? ((slope - 1.0) / (slope + 1.0)) : slope);
    float z = (t * t);
    float tail_1 = (-0.3333295 + (z * (0.19977711 + (z * (-0.13877685 + (z * 0.080537446))))));
    float part = ((steep ? 0.7853982 : 0.0) + (t + ((t * z) * tail_1)));
    float quarter_2 = ((b_3 > a_5) ? (1.5707964 - part) : part);
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

float star_from_ray(float mu, float mu_s, float cosine_1_) {
    float sines = 0.0;
    sines = (sqrt(max(((1.0 - mu) * (1.0 + mu)), 0.0)) * sqrt(max(((1.0 - mu_s) * (1.0 + mu_s)), 0.0)));
    float _e22 = sines;
    return min(max(((mu * mu_s) + (_e22 * cosine_1_)), -1.0), 1.0);
}

Several_i32_i32_i32_f32_f32_ ray_and_star(int index_15) {
    int b_2 = 0;
    int j = 0;
    int ray = 0;
    int i = 0;
    int a_2 = 0;
    float mu_s_1 = 0.0;
    float _e10 = _group_0_binding_0_fs.counts.w;
    int _e12 = whole_rest(index_15, int(_e10));
    b_2 = _e12;
    float _e16 = _group_0_binding_0_fs.counts.w;
    int _e18 = whole_quotient(index_15, int(_e16));
    float _e22 = _group_0_binding_0_fs.counts.z;
    int _e24 = whole_rest(_e18, int(_e22));
    j = _e24;
    float _e28 = _group_0_binding_0_fs.counts.w;
    float _e33 = _group_0_binding_0_fs.counts.z;
    int _e36 = whole_quotient(index_15, (int(_e28) * int(_e33)));
    ray = _e36;
    int _e37 = ray;
    float _e41 = _group_0_binding_0_fs.counts.y;
    int _e43 = whole_quotient(_e37, int(_e41));
    int _e44 = ray;
    float _e48 = _group_0_binding_0_fs.counts.y;
    int _e50 = whole_rest(_e44, int(_e48));
    i = _e43;
    a_2 = _e50;
    int _e51 = j;
    float _e52 = read_sun_cosines(_e51);
    mu_s_1 = _e52;
    int _e53 = ray;
    int _e54 = i;
    int _e55 = a_2;
    float _e56 = mu_s_1;
    int _e57 = i;
    int _e59 = size_mu(1);
    int _e61 = a_2;
    float _e63 = read_mu(((_e57 * _e59) + _e61));
    float _e64 = mu_s_1;
    int _e65 = b_2;
    float _e66 = read_cosines(_e65);
    float _e67 = star_from_ray(_e63, _e64, _e66);
    return Several_i32_i32_i32_f32_f32_(_e53, _e54, _e55, _e56, _e67);
}

Several_f32_f32_ star_from_point(int point, float mu_s_2, float nu) {
    float here = 0.0;
    int _e5 = size_turn(1);
    float _e9 = read_turn(((point * _e5) + 0));
    int _e12 = size_turn(1);
    float _e16 = read_turn(((point * _e12) + 1));
    here = min(max(((_e9 * mu_s_2) + (_e16 * nu)), -1.0), 1.0);
    float _e23 = here;
    int _e25 = size_turn(1);
    float _e29 = read_turn(((point * _e25) + 2));
    int _e32 = size_turn(1);
    float _e36 = read_turn(((point * _e32) + 3));
    return Several_f32_f32_(_e23, ((_e29 * mu_s_2) + (_e36 * nu)));
}

float horizon_cosine(float r, float bottom_radius) {
    return (-(sqrt(max(((r - bottom_radius) * (r + bottom_radius)), 0.0))) / r);
}

float sun_elevation(float r_1, float mu_s_3, float bottom_radius_1) {
    float sine_1_ = 0.0;
    sine_1_ = (bottom_radius_1 / r_1);
    float _e5 = horizon_cosine(r_1, bottom_radius_1);
    float _e7 = sine_1_;
    return ((mu_s_3 - _e5) / _e7);
}

Several_f32_f32_f32_ seen_star(float x_11, float mu_s_4, float bottom, float top) {
    float sine_1_1 = 0.0;
    float horizon = 0.0;
    float tangent = 0.0;
    float at = 0.0;
    int row = 0;
    float f = 0.0;
    float true_horizon = 0.0;
    float above = 0.0;
    float share = 0.0;
    int column = 0;
    float e = 0.0;
    float w00_ = 0.0;
    float w01_ = 0.0;
    float w10_ = 0.0;
    float w11_ = 0.0;
    float raised = 0.0;
    float squeeze = 0.0;
    int _e22 = size_lift(0);
    if ((_e22 == 0)) {
        float _e25 = sun_elevation(x_11, mu_s_4, bottom);
        return Several_f32_f32_f32_(mu_s_4, 1.0, _e25);
    }
    sine_1_1 = (bottom / x_11);
    float _e29 = horizon_cosine(x_11, bottom);
    horizon = _e29;
    tangent = sqrt(((top - bottom) * (top + bottom)));
    float _e40 = tangent;
    int _e43 = size_lift(0);
    at = ((sqrt(max(((x_11 - bottom) * (x_11 + bottom)), 0.0)) / _e40) * float((_e43 - 1)));
    float _e48 = at;
    int _e51 = size_lift(0);
    row = min(int(_e48), (_e51 - 2));
    float _e55 = at;
    int _e56 = row;
    f = (_e55 - float(_e56));
    float _e59 = horizon;
    int _e60 = row;
    int _e62 = size_lift(1);
    int _e67 = size_lift(2);
    float _e71 = read_lift(((((_e60 * _e62) + 0) * _e67) + 0));
    float _e72 = f;
    int _e76 = row;
    int _e80 = size_lift(1);
    int _e85 = size_lift(2);
    float _e89 = read_lift((((((_e76 + 1) * _e80) + 0) * _e85) + 0));
    float _e90 = f;
    true_horizon = (_e59 - ((_e71 * (1.0 - _e72)) + (_e89 * _e90)));
    float _e94 = true_horizon;
    above = (mu_s_4 - _e94);
    float _e96 = above;
    float _e99 = true_horizon;
    int _e107 = size_lift(1);
    share = (sqrt(min((max(_e96, 0.0) / (1.0 - _e99)), 1.0)) * float((_e107 - 1)));
    float _e112 = share;
    int _e115 = size_lift(1);
    column = min(int(_e112), (_e115 - 2));
    float _e119 = share;
    int _e120 = column;
    e = (_e119 - float(_e120));
    float _e123 = f;
    float _e126 = e;
    float now_1_ = ((1.0 - _e123) * (1.0 - _e126));
    float _e130 = f;
    float _e133 = e;
    float now_2_ = ((1.0 - _e130) * _e133);
    w00_ = now_1_;
    w01_ = now_2_;
    float _e135 = f;
    float _e136 = e;
    float now_3_ = (_e135 * (1.0 - _e136));
    float _e140 = f;
    float _e141 = e;
    float now_4_ = (_e140 * _e141);
    w10_ = now_3_;
    w11_ = now_4_;
    float _e143 = w00_;
    int _e144 = row;
    int _e146 = size_lift(1);
    int _e148 = column;
    int _e151 = size_lift(2);
    float _e155 = read_lift(((((_e144 * _e146) + _e148) * _e151) + 0));
    float _e157 = w01_;
    int _e158 = row;
    int _e160 = size_lift(1);
    int _e162 = column;
    int _e167 = size_lift(2);
    float _e171 = read_lift(((((_e158 * _e160) + (_e162 + 1)) * _e167) + 0));
    float _e174 = w10_;
    int _e175 = row;
    int _e179 = size_lift(1);
    int _e181 = column;
    int _e184 = size_lift(2);
    float _e188 = read_lift((((((_e175 + 1) * _e179) + _e181) * _e184) + 0));
    float _e191 = w11_;
    int _e192 = row;
    int _e196 = size_lift(1);
    int _e198 = column;
    int _e203 = size_lift(2);
    float _e207 = read_lift((((((_e192 + 1) * _e196) + (_e198 + 1)) * _e203) + 0));
    raised = ((((_e143 * _e155) + (_e157 * _e171)) + (_e174 * _e188)) + (_e191 * _e207));
    float _e210 = w00_;
    int _e211 = row;
    int _e213 = size_lift(1);
    int _e215 = column;
    int _e218 = size_lift(2);
    float _e222 = read_lift(((((_e211 * _e213) + _e215) * _e218) + 1));
    float _e224 = w01_;
    int _e225 = row;
    int _e227 = size_lift(1);
    int _e229 = column;
    int _e234 = size_lift(2);
    float _e238 = read_lift(((((_e225 * _e227) + (_e229 + 1)) * _e234) + 1));
    float _e241 = w10_;
    int _e242 = row;
    int _e246 = size_lift(1);
    int _e248 = column;
    int _e251 = size_lift(2);
    float _e255 = read_lift((((((_e242 + 1) * _e246) + _e248) * _e251) + 1));
    float _e258 = w11_;
    int _e259 = row;
    int _e263 = size_lift(1);
    int _e265 = column;
    int _e270 = size_lift(2);
    float _e274 = read_lift((((((_e259 + 1) * _e263) + (_e265 + 1)) * _e270) + 1));
    squeeze = ((((_e210 * _e222) + (_e224 * _e238)) + (_e241 * _e255)) + (_e258 * _e274));
    float _e277 = raised;
    float _e281 = squeeze;
    float _e282 = above;
    float _e283 = sine_1_1;
    return Several_f32_f32_f32_(min((mu_s_4 + _e277), 1.0), _e281, (_e282 / _e283));
}

float visible_fraction(float elevation, float angular_radius) {
    float x_12 = 0.0;
    if ((angular_radius <= 0.0)) {
        return ((elevation > 0.0) ? 1.0 : 0.0);
    }
    x_12 = (elevation / angular_radius);
    float _e11 = x_12;
    if ((_e11 >= 1.0)) {
        return 1.0;
    }
    float _e15 = x_12;
    if ((_e15 <= -1.0)) {
        return 0.0;
    }
    float _e19 = x_12;
    float _e21 = arc_cosine(-(_e19));
    float _e22 = x_12;
    float _e23 = x_12;
    float _e24 = x_12;
    return ((_e21 + (_e22 * sqrt((1.0 - (_e23 * _e24))))) / 3.1415927);
}

Several_f32_f32_ visible_spread(float elevation_1, float angular_radius_1) {
    float x_13 = 0.0;
    float rest = 0.0;
    float area = 0.0;
    float mean = 0.0;
    float square = 0.0;
    float deviation = 0.0;
    x_13 = (elevation_1 / angular_radius_1);
    float _e9 = x_13;
    if ((_e9 >= 1.0)) {
        return Several_f32_f32_(elevation_1, (0.5 * angular_radius_1));
    }
    float _e15 = x_13;
    float _e18 = x_13;
    rest = sqrt(max(((1.0 - _e15) * (1.0 + _e18)), 0.0));
    float _e25 = x_13;
    float _e27 = arc_cosine(-(_e25));
    float _e28 = x_13;
    float _e29 = rest;
    area = (_e27 + (_e28 * _e29));
    float _e32 = area;
    if ((_e32 < 1e-9)) {
        return Several_f32_f32_(0.0, 0.0);
    }
    float _e38 = rest;
    float _e41 = rest;
    float _e43 = rest;
    float _e45 = area;
    mean = ((((2.0 * _e38) * _e41) * _e43) / (3.0 * _e45));
    float _e49 = x_13;
    float _e50 = arc_sine(_e49);
    float _e53 = x_13;
    float _e54 = rest;
    float _e56 = x_13;
    float _e59 = x_13;
    float _e65 = area;
    square = (((1.5707964 + _e50) - ((_e53 * _e54) * (1.0 - ((2.0 * _e56) * _e59)))) / (4.0 * _e65));
    float _e69 = square;
    float _e70 = mean;
    float _e71 = mean;
    deviation = sqrt(max((_e69 - (_e70 * _e71)), 0.0));
    float _e77 = mean;
    float _e80 = deviation;
    return Several_f32_f32_((elevation_1 + (angular_radius_1 * _e77)), (angular_radius_1 * _e80));
}

Several_f32_f32_f32_ star_points(float x_14, float mu_s_5, float bottom_1, float top_1, float star_radius) {
    float seen = 0.0;
    float squeeze_1 = 0.0;
    float elevation_2 = 0.0;
    float received = 0.0;
    float mean_1 = 0.0;
    float deviation_1 = 0.0;
    float middle = 0.0;
    float apart = 0.0;
    float lowest = 0.0;
    bool local_3 = false;
    bool local_4 = false;
    Several_f32_f32_f32_ _e14 = seen_star(x_14, mu_s_5, bottom_1, top_1);
    seen = _e14.v0_;
    squeeze_1 = _e14.v1_;
    elevation_2 = _e14.v2_;
    float _e18 = squeeze_1;
    float _e19 = elevation_2;
    float _e20 = visible_fraction(_e19, star_radius);
    received = (_e18 * _e20);
    float _e22 = received;
    if (!((_e22 <= 0.0))) {
        local_3 = (star_radius <= 0.0);
    } else {
        local_3 = true;
    }
    bool _e31 = local_3;
    if (!(_e31)) {
        float _e35 = elevation_2;
        local_4 = (_e35 > (16.0 * star_radius));
    } else {
        local_4 = true;
    }
    bool _e40 = local_4;
    if (_e40) {
        float _e41 = received;
        float _e42 = seen;
        float _e43 = seen;
        return Several_f32_f32_f32_(_e41, _e42, _e43);
    }
    float _e45 = elevation_2;
    Several_f32_f32_ _e46 = visible_spread(_e45, star_radius);
    mean_1 = _e46.v0_;
    deviation_1 = _e46.v1_;
    float _e49 = seen;
    float _e50 = squeeze_1;
    float _e53 = mean_1;
    float _e54 = elevation_2;
    middle = (_e49 + ((_e50 * (bottom_1 / x_14)) * (_e53 - _e54)));
    float _e58 = squeeze_1;
    float _e61 = deviation_1;
    apart = ((_e58 * (bottom_1 / x_14)) * _e61);
    float _e63 = horizon_cosine(x_14, bottom_1);
    lowest = _e63;
    float _e64 = received;
    float _e65 = middle;
    float _e66 = apart;
    float _e68 = lowest;
    float _e70 = middle;
    float _e71 = apart;
    return Several_f32_f32_f32_(_e64, max((_e65 - _e66), _e68), min((_e70 + _e71), 1.0));
}

float chord(float r_2, float mu_1, float radius) {
    return sqrt(max((((radius - r_2) * (radius + r_2)) + (((r_2 * r_2) * mu_1) * mu_1)), 0.0));
}

float distance_to_top(float r_3, float mu_2, float top_radius) {
    float _e5 = chord(r_3, mu_2, top_radius);
    return max(((-(r_3) * mu_2) + _e5), 0.0);
}

float direction_coordinate(float r_4, float mu_3, float bottom_radius_2, float top_radius_1) {
    float shortest = 0.0;
    float longest = 0.0;
    float distance_1_ = 0.0;
    shortest = (top_radius_1 - r_4);
    longest = (sqrt(max(((r_4 - bottom_radius_2) * (r_4 + bottom_radius_2)), 0.0)) + sqrt(((top_radius_1 - bottom_radius_2) * (top_radius_1 + bottom_radius_2))));
    float _e19 = distance_to_top(r_4, mu_3, top_radius_1);
    distance_1_ = _e19;
    float _e20 = distance_1_;
    float _e21 = shortest;
    float _e23 = longest;
    float _e24 = shortest;
    return min(max(((_e20 - _e21) / (_e23 - _e24)), 0.0), 1.0);
}

vec4 through_row(int local_5, float x_15, int directions) {
    int place = 0;
    float f_1 = 0.0;
    int at_1 = 0;
    place = min(int(x_15), (directions - 2));
    int _e10 = place;
    f_1 = (x_15 - float(_e10));
    int _e14 = place;
    at_1 = (1 * ((local_5 * directions) + _e14));
    float _e18 = f_1;
    int _e21 = at_1;
    vec4 _e22 = read_depths_table(_e21);
    float _e24 = f_1;
    int _e25 = at_1;
    vec4 _e28 = read_depths_table((_e25 + 1));
    return exp((vec4(0.0) - (((1.0 - _e18) * _e22) + (_e24 * _e28))));
}

float star_at_end(int i_1, int a_3, float mu_s_6, float nu_1) {
    int _e5 = size_end(1);
    int _e9 = size_end(2);
    float _e13 = read_end(((((i_1 * _e5) + a_3) * _e9) + 0));
    int _e16 = size_end(1);
    int _e20 = size_end(2);
    float _e24 = read_end(((((i_1 * _e16) + a_3) * _e20) + 1));
    return min(max(((_e13 * mu_s_6) + (_e24 * nu_1)), -1.0), 1.0);
}

Several_f32_f32_f32_f32_ level_light(float x_16, float mu_s_7, float bottom_2, float top_2, float star_radius_1) {
    float received_1 = 0.0;
    float low = 0.0;
    float high = 0.0;
    Several_f32_f32_f32_ _e8 = star_points(x_16, mu_s_7, bottom_2, top_2, star_radius_1);
    received_1 = _e8.v0_;
    low = _e8.v1_;
    high = _e8.v2_;
    float _e12 = low;
    float now_2_1 = max(_e12, 0.0);
    float _e15 = high;
    float now_3_1 = max(_e15, 0.0);
    low = now_2_1;
    high = now_3_1;
    float _e18 = received_1;
    float _e21 = low;
    float _e23 = received_1;
    float _e26 = high;
    float _e28 = low;
    float _e29 = high;
    return Several_f32_f32_f32_f32_(((0.5 * _e18) * _e21), ((0.5 * _e23) * _e26), _e28, _e29);
}

vec4 through_row_2_(float x_17, int directions_1) {
    int place_1 = 0;
    float f_2 = 0.0;
    int at_2 = 0;
    place_1 = min(int(x_17), (directions_1 - 2));
    int _e9 = place_1;
    f_2 = (x_17 - float(_e9));
    int _e14 = place_1;
    at_2 = (1 * ((0 * directions_1) + _e14));
    float _e18 = f_2;
    int _e21 = at_2;
    vec4 _e22 = read_depths_table(_e21);
    float _e24 = f_2;
    int _e25 = at_2;
    vec4 _e28 = read_depths_table((_e25 + 1));
    return exp((vec4(0.0) - (((1.0 - _e18) * _e22) + (_e24 * _e28))));
}

vec4 direct_light(float mu_s_8, float bottom_3, float top_3, float star_radius_2, int directions_2) {
    float from_low = 0.0;
    float from_high = 0.0;
    float low_1 = 0.0;
    float high_1 = 0.0;
    float x_18 = 0.0;
    vec4 light = vec4(0.0);
    Several_f32_f32_f32_f32_ _e11 = level_light(bottom_3, mu_s_8, bottom_3, top_3, star_radius_2);
    from_low = _e11.v0_;
    from_high = _e11.v1_;
    low_1 = _e11.v2_;
    high_1 = _e11.v3_;
    float _e16 = low_1;
    float _e17 = direction_coordinate(bottom_3, _e16, bottom_3, top_3);
    x_18 = (_e17 * float((directions_2 - 1)));
    float _e22 = x_18;
    vec4 _e23 = through_row_2_(_e22, directions_2);
    float _e24 = from_low;
    light = (_e23 * _e24);
    float _e26 = high_1;
    float _e27 = direction_coordinate(bottom_3, _e26, bottom_3, top_3);
    x_18 = (_e27 * float((directions_2 - 1)));
    vec4 _e32 = light;
    float _e33 = x_18;
    vec4 _e34 = through_row_2_(_e33, directions_2);
    float _e35 = from_high;
    return (_e32 + (_e34 * _e35));
}

void fill_phases_1_(float nu_2, int degree, int constituents) {
    int c = 0;
    vec4 total = vec4(0.0);
    float before = 0.0;
    float value = 0.0;
    int l = 0;
    float following = 0.0;
    c = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e261 = c;
            c = (_e261 + 1);
        }
        loop_init = false;
        int _e10 = c;
        if ((_e10 < constituents)) {
        } else {
            break;
        }
        {
            total = vec4(0.0);
            before = 0.0;
            value = 1.0;
            int end_3_ = (degree + 1);
            l = 0;
            bool loop_init_1 = true;
            while(true) {
                if (!loop_init_1) {
                    int _e204 = l;
                    l = (_e204 + 1);
                }
                loop_init_1 = false;
                int _e19 = l;
                if (((_e19 + 3) < end_3_)) {
                } else {
                    break;
                }
                {
                    vec4 _e23 = total;
                    int _e24 = c;
                    int _e28 = l;
                    vec4 _e32 = read_moments((1 * ((_e24 * (degree + 1)) + _e28)));
                    int _e33 = l;
                    float _e41 = value;
                    total = (_e23 + (_e32 * ((float(((2 * _e33) + 1)) * 0.07957747) * _e41)));
                    int _e45 = l;
                    float _e52 = value;
                    int _e54 = l;
                    float _e56 = before;
                    int _e59 = l;
                    following = ((((float(((2 * _e45) + 1)) * nu_2) * _e52) - (float(_e54) * _e56)) / float((_e59 + 1)));
                    float now_4_1 = value;
                    float now_5_ = following;
                    before = now_4_1;
                    value = now_5_;
                    int _e66 = l;
                    l = (_e66 + 1);
                    vec4 _e69 = total;
                    int _e70 = c;
                    int _e74 = l;
                    vec4 _e78 = read_moments((1 * ((_e70 * (degree + 1)) + _e74)));
                    int _e79 = l;
                    float _e87 = value;
                    total = (_e69 + (_e78 * ((float(((2 * _e79) + 1)) * 0.07957747) * _e87)));
                    int _e91 = l;
                    float _e98 = value;
                    int _e100 = l;
                    float _e102 = before;
                    int _e105 = l;
                    following = ((((float(((2 * _e91) + 1)) * nu_2) * _e98) - (float(_e100) * _e102)) / float((_e105 + 1)));
                    float now_6_ = value;
                    float now_7_ = following;
                    before = now_6_;
                    value = now_7_;
                    int _e112 = l;
                    l = (_e112 + 1);
                    vec4 _e115 = total;
                    int _e116 = c;
                    int _e120 = l;
                    vec4 _e124 = read_moments((1 * ((_e116 * (degree + 1)) + _e120)));
                    int _e125 = l;
                    float _e133 = value;
                    total = (_e115 + (_e124 * ((float(((2 * _e125) + 1)) * 0.07957747) * _e133)));
                    int _e137 = l;
                    float _e144 = value;
                    int _e146 = l;
                    float _e148 = before;
                    int _e151 = l;
                    following = ((((float(((2 * _e137) + 1)) * nu_2) * _e144) - (float(_e146) * _e148)) / float((_e151 + 1)));
                    float now_8_ = value;
                    float now_9_ = following;
                    before = now_8_;
                    value = now_9_;
                    int _e158 = l;
                    l = (_e158 + 1);
                    vec4 _e161 = total;
                    int _e162 = c;
                    int _e166 = l;
                    vec4 _e170 = read_moments((1 * ((_e162 * (degree + 1)) + _e166)));
                    int _e171 = l;
                    float _e179 = value;
                    total = (_e161 + (_e170 * ((float(((2 * _e171) + 1)) * 0.07957747) * _e179)));
                    int _e183 = l;
                    float _e190 = value;
                    int _e192 = l;
                    float _e194 = before;
                    int _e197 = l;
                    following = ((((float(((2 * _e183) + 1)) * nu_2) * _e190) - (float(_e192) * _e194)) / float((_e197 + 1)));
                    float now_10_ = value;
                    float now_11_ = following;
                    before = now_10_;
                    value = now_11_;
                }
            }
            bool loop_init_2 = true;
            while(true) {
                if (!loop_init_2) {
                    int _e252 = l;
                    l = (_e252 + 1);
                }
                loop_init_2 = false;
                int _e207 = l;
                if ((_e207 < end_3_)) {
                } else {
                    break;
                }
                {
                    vec4 _e209 = total;
                    int _e210 = c;
                    int _e214 = l;
                    vec4 _e218 = read_moments((1 * ((_e210 * (degree + 1)) + _e214)));
                    int _e219 = l;
                    float _e227 = value;
                    total = (_e209 + (_e218 * ((float(((2 * _e219) + 1)) * 0.07957747) * _e227)));
                    int _e231 = l;
                    float _e238 = value;
                    int _e240 = l;
                    float _e242 = before;
                    int _e245 = l;
                    following = ((((float(((2 * _e231) + 1)) * nu_2) * _e238) - (float(_e240) * _e242)) / float((_e245 + 1)));
                    float now_12_ = value;
                    float now_13_ = following;
                    before = now_12_;
                    value = now_13_;
                }
            }
            int _e256 = c;
            vec4 _e260 = total;
            radiance_once_phases[(1 * _e256)] = _e260;
        }
    }
    return;
}

vec4 scattered_once_1_(int first, int points, int strong, int constituents_1, int deep, int directions_3, float mu_s_9, float nu_3, float bottom_4, float top_4, float star_radius_3) {
    vec4 radiance = vec4(0.0);
    int k = 0;
    float q = 0.0;
    float mu_sk = 0.0;
    float seen_1 = 0.0;
    float low_2 = 0.0;
    float high_2 = 0.0;
    float x_19 = 0.0;
    vec4 light_1 = vec4(0.0);
    vec4 source = vec4(0.0);
    int c_1 = 0;
    radiance = vec4(0.0);
    k = 0;
    bool loop_init_3 = true;
    while(true) {
        if (!loop_init_3) {
            int _e189 = k;
            k = (_e189 + 1);
        }
        loop_init_3 = false;
        int _e25 = k;
        if ((_e25 < points)) {
        } else {
            break;
        }
        {
            int _e27 = k;
            float _e29 = read_radius((first + _e27));
            q = _e29;
            int _e30 = k;
            Several_f32_f32_ _e32 = star_from_point((first + _e30), mu_s_9, nu_3);
            mu_sk = _e32.v0_;
            float _e34 = q;
            float _e35 = mu_sk;
            Several_f32_f32_f32_ _e36 = star_points(_e34, _e35, bottom_4, top_4, star_radius_3);
            seen_1 = _e36.v0_;
            low_2 = _e36.v1_;
            high_2 = _e36.v2_;
            float _e40 = seen_1;
            if ((_e40 <= 0.0)) {
                continue;
            }
            float _e43 = q;
            float _e44 = low_2;
            float _e45 = direction_coordinate(_e43, _e44, bottom_4, top_4);
            x_19 = (_e45 * float((directions_3 - 1)));
            int _e50 = k;
            float _e52 = x_19;
            vec4 _e53 = through_row((deep + _e50), _e52, directions_3);
            light_1 = _e53;
            float _e54 = high_2;
            float _e55 = low_2;
            if ((_e54 > _e55)) {
                float _e57 = q;
                float _e58 = high_2;
                float _e59 = direction_coordinate(_e57, _e58, bottom_4, top_4);
                x_19 = (_e59 * float((directions_3 - 1)));
                vec4 _e64 = light_1;
                int _e65 = k;
                float _e67 = x_19;
                vec4 _e68 = through_row((deep + _e65), _e67, directions_3);
                light_1 = (_e64 + _e68);
                vec4 _e70 = light_1;
                light_1 = (_e70 * 0.5);
            }
            source = vec4(0.0);
            c_1 = 0;
            bool loop_init_4 = true;
            while(true) {
                if (!loop_init_4) {
                    int _e157 = c_1;
                    c_1 = (_e157 + 1);
                }
                loop_init_4 = false;
                int _e76 = c_1;
                if (((_e76 + 3) < constituents_1)) {
                } else {
                    break;
                }
                {
                    vec4 _e80 = source;
                    int _e82 = c_1;
                    vec4 _e86 = radiance_once_phases[(1 * _e82)];
                    int _e87 = k;
                    int _e90 = c_1;
                    vec4 _e94 = read_strengths_table((1 * (((strong + _e87) * constituents_1) + _e90)));
                    source = (_e80 + (_e86 * _e94));
                    int _e97 = c_1;
                    c_1 = (_e97 + 1);
                    vec4 _e100 = source;
                    int _e102 = c_1;
                    vec4 _e106 = radiance_once_phases[(1 * _e102)];
                    int _e107 = k;
                    int _e110 = c_1;
                    vec4 _e114 = read_strengths_table((1 * (((strong + _e107) * constituents_1) + _e110)));
                    source = (_e100 + (_e106 * _e114));
                    int _e117 = c_1;
                    c_1 = (_e117 + 1);
                    vec4 _e120 = source;
                    int _e122 = c_1;
                    vec4 _e126 = radiance_once_phases[(1 * _e122)];
                    int _e127 = k;
                    int _e130 = c_1;
                    vec4 _e134 = read_strengths_table((1 * (((strong + _e127) * constituents_1) + _e130)));
                    source = (_e120 + (_e126 * _e134));
                    int _e137 = c_1;
                    c_1 = (_e137 + 1);
                    vec4 _e140 = source;
                    int _e142 = c_1;
                    vec4 _e146 = radiance_once_phases[(1 * _e142)];
                    int _e147 = k;
                    int _e150 = c_1;
                    vec4 _e154 = read_strengths_table((1 * (((strong + _e147) * constituents_1) + _e150)));
                    source = (_e140 + (_e146 * _e154));
                }
            }
            bool loop_init_5 = true;
            while(true) {
                if (!loop_init_5) {
                    int _e179 = c_1;
                    c_1 = (_e179 + 1);
                }
                loop_init_5 = false;
                int _e160 = c_1;
                if ((_e160 < constituents_1)) {
                } else {
                    break;
                }
                {
                    vec4 _e162 = source;
                    int _e164 = c_1;
                    vec4 _e168 = radiance_once_phases[(1 * _e164)];
                    int _e169 = k;
                    int _e172 = c_1;
                    vec4 _e176 = read_strengths_table((1 * (((strong + _e169) * constituents_1) + _e172)));
                    source = (_e162 + (_e168 * _e176));
                }
            }
            vec4 _e182 = radiance;
            float _e183 = seen_1;
            vec4 _e184 = light_1;
            vec4 _e186 = source;
            radiance = (_e182 + ((_e183 * _e184) * _e186));
        }
    }
    vec4 _e192 = radiance;
    return _e192;
}

vec4 radiance_once(int index_16, int first_point) {
    int ray_1 = 0;
    int i_2 = 0;
    int a_4 = 0;
    float mu_s_10 = 0.0;
    float nu_4 = 0.0;
    int first_1 = 0;
    int points_1 = 0;
    vec4 radiance_1 = vec4(0.0);
    float at_ground = 0.0;
    Several_i32_i32_i32_f32_f32_ _e11 = ray_and_star(index_16);
    ray_1 = _e11.v0_;
    i_2 = _e11.v1_;
    a_4 = _e11.v2_;
    mu_s_10 = _e11.v3_;
    nu_4 = _e11.v4_;
    int _e17 = i_2;
    int _e19 = size_start(1);
    int _e21 = a_4;
    float _e23 = read_start(((_e17 * _e19) + _e21));
    first_1 = int(_e23);
    int _e25 = i_2;
    int _e27 = size_start(1);
    int _e29 = a_4;
    float _e33 = read_start(((_e25 * _e27) + (_e29 + 1)));
    int _e35 = first_1;
    points_1 = (int(_e33) - _e35);
    float _e37 = nu_4;
    float _e41 = _group_0_binding_0_fs.more_counts.x;
    float _e46 = _group_0_binding_0_fs.more_counts.z;
    fill_phases_1_(_e37, int(_e41), int(_e46));
    int _e48 = ray_1;
    vec4 _e51 = read_shares_table((1 * _e48));
    int _e52 = first_1;
    int _e53 = points_1;
    int _e54 = first_1;
    float _e58 = _group_0_binding_0_fs.more_counts.z;
    int _e60 = first_1;
    float _e67 = _group_0_binding_0_fs.more_counts.w;
    float _e69 = mu_s_10;
    float _e70 = nu_4;
    float _e74 = _group_0_binding_0_fs.measures.x;
    float _e78 = _group_0_binding_0_fs.measures.y;
    float _e82 = _group_0_binding_0_fs.measures.z;
    vec4 _e83 = scattered_once_1_(_e52, _e53, _e54, int(_e58), ((1 + _e60) - first_point), int(_e67), _e69, _e70, _e74, _e78, _e82);
    radiance_1 = (_e51 * _e83);
    int _e85 = a_4;
    float _e89 = _group_0_binding_0_fs.counts.y;
    int _e92 = whole_quotient(int(_e89), 2);
    if ((_e85 < _e92)) {
        int _e94 = i_2;
        int _e95 = a_4;
        float _e96 = mu_s_10;
        float _e97 = nu_4;
        float _e98 = star_at_end(_e94, _e95, _e96, _e97);
        at_ground = _e98;
        vec4 _e99 = radiance_1;
        int _e100 = ray_1;
        vec4 _e103 = read_reflections_table((1 * _e100));
        float _e104 = at_ground;
        float _e108 = _group_0_binding_0_fs.measures.x;
        float _e112 = _group_0_binding_0_fs.measures.y;
        float _e116 = _group_0_binding_0_fs.measures.z;
        float _e120 = _group_0_binding_0_fs.more_counts.w;
        vec4 _e122 = direct_light(_e104, _e108, _e112, _e116, int(_e120));
        radiance_1 = (_e99 + (_e103 * _e122));
    }
    vec4 _e125 = radiance_1;
    return _e125;
}

vec4 texel(int index_17) {
    float _e4 = _group_0_binding_1_fs.texels.z;
    vec4 _e6 = radiance_once(index_17, int(_e4));
    return _e6;
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_18 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first_2 = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_18, first_2), last));
    if (!((index_18 < first_2))) {
        local = (index_18 > last);
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
