#version 300 es
// of solver_radiance_again.wgsl 13eece6c7ebe5f85, by naga-wasm@30.1.0
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
layout(std140) uniform Solve_block_0Fragment { Solve _group_0_binding_0_fs; };

layout(std140) uniform Span_block_1Fragment { Span _group_0_binding_1_fs; };

uniform highp sampler2D _group_0_binding_3_fs;

uniform highp sampler2D _group_0_binding_4_fs;

uniform highp sampler2D _group_0_binding_5_fs;

uniform highp sampler2D _group_0_binding_6_fs;

uniform highp sampler2D _group_0_binding_7_fs;

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

float read_mu_along(int index_4) {
    float _e5 = _group_0_binding_0_fs.mu_along_start.x;
    ivec2 _e8 = texel_place((index_4 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_mu_along(int axis_3) {
    float _e4 = _group_0_binding_0_fs.mu_along_shape[axis_3];
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

float read_place(int index_7) {
    float _e5 = _group_0_binding_0_fs.place_start.x;
    ivec2 _e8 = texel_place((index_7 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_7_fs, _e8, 0);
    return _e10.x;
}

int size_place(int axis_6) {
    float _e4 = _group_0_binding_0_fs.place_shape[axis_6];
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

vec4 read_shares_table(int index_9) {
    ivec2 _e2 = texel_place(index_9);
    vec4 _e4 = texelFetch(_group_0_binding_3_fs, _e2, 0);
    return _e4;
}

vec4 read_rows_table(int index_10) {
    ivec2 _e2 = texel_place(index_10);
    vec4 _e4 = texelFetch(_group_0_binding_4_fs, _e2, 0);
    return _e4;
}

vec4 read_reflections_table(int index_11) {
    ivec2 _e2 = texel_place(index_11);
    vec4 _e4 = texelFetch(_group_0_binding_5_fs, _e2, 0);
    return _e4;
}

vec4 read_ground_table(int index_12) {
    float _e5 = _group_0_binding_0_fs.measures.w;
    ivec2 _e8 = texel_place((index_12 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_6_fs, _e8, 0);
    return _e10;
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

Several_i32_i32_i32_f32_f32_ ray_and_star(int index_13) {
    int b_2 = 0;
    int j = 0;
    int ray = 0;
    int i = 0;
    int a_2 = 0;
    float mu_s_1 = 0.0;
    float _e10 = _group_0_binding_0_fs.counts.w;
    int _e12 = whole_rest(index_13, int(_e10));
    b_2 = _e12;
    float _e16 = _group_0_binding_0_fs.counts.w;
    int _e18 = whole_quotient(index_13, int(_e16));
    float _e22 = _group_0_binding_0_fs.counts.z;
    int _e24 = whole_rest(_e18, int(_e22));
    j = _e24;
    float _e28 = _group_0_binding_0_fs.counts.w;
    float _e33 = _group_0_binding_0_fs.counts.z;
    int _e36 = whole_quotient(index_13, (int(_e28) * int(_e33)));
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

float place_of(float mu_s_3) {
    float x_11 = 0.0;
    int k = 0;
    int _e6 = size_place(0);
    x_11 = ((mu_s_3 + 1.0) * (0.5 * float((_e6 - 1))));
    float _e13 = x_11;
    int _e18 = size_place(0);
    k = min(max(int(_e13), 0), (_e18 - 2));
    int _e22 = k;
    float _e23 = read_place(_e22);
    int _e24 = k;
    float _e27 = read_place((_e24 + 1));
    int _e28 = k;
    float _e29 = read_place(_e28);
    float _e31 = x_11;
    int _e32 = k;
    return (_e23 + ((_e27 - _e29) * (_e31 - float(_e32))));
}

float azimuth_cosine(float mu_1, float mu_s_4, float nu_1) {
    float spread = 0.0;
    spread = ((((1.0 - mu_1) * (1.0 + mu_1)) * (1.0 - mu_s_4)) * (1.0 + mu_s_4));
    float _e17 = spread;
    return min(max(((nu_1 - (mu_1 * mu_s_4)) / sqrt(max(_e17, 1e-24))), -1.0), 1.0);
}

vec4 gathered(int first, int points, int local_3, float mu_s_5, float nu_2, int suns, int degree) {
    int block = 0;
    vec4 radiance = vec4(0.0);
    int k_1 = 0;
    float mu_sk = 0.0;
    float nu_k = 0.0;
    float x_12 = 0.0;
    int column = 0;
    float f = 0.0;
    float g = 0.0;
    float step_1_ = 0.0;
    int low = 0;
    int high = 0;
    vec4 scale = vec4(0.0);
    vec4 total = vec4(0.0);
    float before = 0.0;
    float multiple = 0.0;
    int m = 0;
    int at = 0;
    float following = 0.0;
    block = ((degree + 2) * 1);
    radiance = vec4(0.0);
    k_1 = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e278 = k_1;
            k_1 = (_e278 + 1);
        }
        loop_init = false;
        int _e33 = k_1;
        if ((_e33 < points)) {
        } else {
            break;
        }
        {
            int _e35 = k_1;
            Several_f32_f32_ _e37 = star_from_point((first + _e35), mu_s_5, nu_2);
            mu_sk = _e37.v0_;
            nu_k = _e37.v1_;
            float _e40 = mu_sk;
            float _e41 = place_of(_e40);
            x_12 = _e41;
            float _e42 = x_12;
            column = min(int(_e42), (suns - 2));
            float _e47 = x_12;
            int _e48 = column;
            f = (_e47 - float(_e48));
            float _e51 = f;
            g = (1.0 - _e51);
            int _e54 = k_1;
            float _e56 = read_mu_along((first + _e54));
            float _e57 = mu_sk;
            float _e58 = nu_k;
            float _e59 = azimuth_cosine(_e56, _e57, _e58);
            step_1_ = _e59;
            int _e60 = k_1;
            int _e63 = column;
            int _e65 = block;
            low = ((((local_3 + _e60) * suns) + _e63) * _e65);
            int _e67 = low;
            int _e68 = block;
            high = (_e67 + _e68);
            float _e70 = g;
            int _e71 = low;
            vec4 _e72 = read_rows_table(_e71);
            float _e74 = f;
            int _e75 = high;
            vec4 _e76 = read_rows_table(_e75);
            scale = ((_e70 * _e72) + (_e74 * _e76));
            float _e79 = g;
            int _e80 = low;
            vec4 _e83 = read_rows_table((_e80 + 1));
            float _e85 = f;
            int _e86 = high;
            vec4 _e89 = read_rows_table((_e86 + 1));
            total = ((_e79 * _e83) + (_e85 * _e89));
            before = 1.0;
            float _e93 = step_1_;
            multiple = _e93;
            int end_2_ = (degree + 1);
            m = 1;
            bool loop_init_1 = true;
            while(true) {
                if (!loop_init_1) {
                    int _e234 = m;
                    m = (_e234 + 1);
                }
                loop_init_1 = false;
                int _e97 = m;
                if (((_e97 + 3) < end_2_)) {
                } else {
                    break;
                }
                {
                    int _e101 = m;
                    at = (1 * (1 + _e101));
                    vec4 _e106 = total;
                    float _e107 = multiple;
                    float _e108 = g;
                    int _e109 = low;
                    int _e110 = at;
                    vec4 _e112 = read_rows_table((_e109 + _e110));
                    float _e114 = f;
                    int _e115 = high;
                    int _e116 = at;
                    vec4 _e118 = read_rows_table((_e115 + _e116));
                    total = (_e106 + (_e107 * ((_e108 * _e112) + (_e114 * _e118))));
                    float _e123 = step_1_;
                    float _e126 = multiple;
                    float _e128 = before;
                    following = (((2.0 * _e123) * _e126) - _e128);
                    float _e130 = multiple;
                    before = _e130;
                    float _e131 = following;
                    multiple = _e131;
                    int _e132 = m;
                    m = (_e132 + 1);
                    int _e135 = m;
                    at = (1 * (1 + _e135));
                    vec4 _e140 = total;
                    float _e141 = multiple;
                    float _e142 = g;
                    int _e143 = low;
                    int _e144 = at;
                    vec4 _e146 = read_rows_table((_e143 + _e144));
                    float _e148 = f;
                    int _e149 = high;
                    int _e150 = at;
                    vec4 _e152 = read_rows_table((_e149 + _e150));
                    total = (_e140 + (_e141 * ((_e142 * _e146) + (_e148 * _e152))));
                    float _e157 = step_1_;
                    float _e160 = multiple;
                    float _e162 = before;
                    following = (((2.0 * _e157) * _e160) - _e162);
                    float _e164 = multiple;
                    before = _e164;
                    float _e165 = following;
                    multiple = _e165;
                    int _e166 = m;
                    m = (_e166 + 1);
                    int _e169 = m;
                    at = (1 * (1 + _e169));
                    vec4 _e174 = total;
                    float _e175 = multiple;
                    float _e176 = g;
                    int _e177 = low;
                    int _e178 = at;
                    vec4 _e180 = read_rows_table((_e177 + _e178));
                    float _e182 = f;
                    int _e183 = high;
                    int _e184 = at;
                    vec4 _e186 = read_rows_table((_e183 + _e184));
                    total = (_e174 + (_e175 * ((_e176 * _e180) + (_e182 * _e186))));
                    float _e191 = step_1_;
                    float _e194 = multiple;
                    float _e196 = before;
                    following = (((2.0 * _e191) * _e194) - _e196);
                    float _e198 = multiple;
                    before = _e198;
                    float _e199 = following;
                    multiple = _e199;
                    int _e200 = m;
                    m = (_e200 + 1);
                    int _e203 = m;
                    at = (1 * (1 + _e203));
                    vec4 _e208 = total;
                    float _e209 = multiple;
                    float _e210 = g;
                    int _e211 = low;
                    int _e212 = at;
                    vec4 _e214 = read_rows_table((_e211 + _e212));
                    float _e216 = f;
                    int _e217 = high;
                    int _e218 = at;
                    vec4 _e220 = read_rows_table((_e217 + _e218));
                    total = (_e208 + (_e209 * ((_e210 * _e214) + (_e216 * _e220))));
                    float _e225 = step_1_;
                    float _e228 = multiple;
                    float _e230 = before;
                    following = (((2.0 * _e225) * _e228) - _e230);
                    float _e232 = multiple;
                    before = _e232;
                    float _e233 = following;
                    multiple = _e233;
                }
            }
            bool loop_init_2 = true;
            while(true) {
                if (!loop_init_2) {
                    int _e270 = m;
                    m = (_e270 + 1);
                }
                loop_init_2 = false;
                int _e237 = m;
                if ((_e237 < end_2_)) {
                } else {
                    break;
                }
                {
                    int _e239 = m;
                    at = (1 * (1 + _e239));
                    vec4 _e244 = total;
                    float _e245 = multiple;
                    float _e246 = g;
                    int _e247 = low;
                    int _e248 = at;
                    vec4 _e250 = read_rows_table((_e247 + _e248));
                    float _e252 = f;
                    int _e253 = high;
                    int _e254 = at;
                    vec4 _e256 = read_rows_table((_e253 + _e254));
                    total = (_e244 + (_e245 * ((_e246 * _e250) + (_e252 * _e256))));
                    float _e261 = step_1_;
                    float _e264 = multiple;
                    float _e266 = before;
                    following = (((2.0 * _e261) * _e264) - _e266);
                    float _e268 = multiple;
                    before = _e268;
                    float _e269 = following;
                    multiple = _e269;
                }
            }
            vec4 _e273 = radiance;
            vec4 _e274 = total;
            vec4 _e275 = scale;
            radiance = (_e273 + (_e274 / _e275));
        }
    }
    vec4 _e281 = radiance;
    return _e281;
}

float star_at_end(int i_1, int a_3, float mu_s_6, float nu_3) {
    int _e5 = size_end(1);
    int _e9 = size_end(2);
    float _e13 = read_end(((((i_1 * _e5) + a_3) * _e9) + 0));
    int _e16 = size_end(1);
    int _e20 = size_end(2);
    float _e24 = read_end(((((i_1 * _e16) + a_3) * _e20) + 1));
    return min(max(((_e13 * mu_s_6) + (_e24 * nu_3)), -1.0), 1.0);
}

vec4 sky_at(float mu_s_7, int suns_1) {
    float x_13 = 0.0;
    int column_1 = 0;
    float f_1 = 0.0;
    float g_1 = 0.0;
    int low_1 = 0;
    float _e7 = place_of(mu_s_7);
    x_13 = _e7;
    float _e8 = x_13;
    column_1 = min(int(_e8), (suns_1 - 2));
    float _e13 = x_13;
    int _e14 = column_1;
    f_1 = (_e13 - float(_e14));
    float _e17 = f_1;
    g_1 = (1.0 - _e17);
    int _e20 = column_1;
    low_1 = ((_e20 * 2) * 1);
    float _e25 = g_1;
    int _e26 = low_1;
    vec4 _e29 = read_ground_table((_e26 + 1));
    float _e31 = f_1;
    int _e32 = low_1;
    vec4 _e35 = read_ground_table((_e32 + 3));
    float _e38 = g_1;
    int _e39 = low_1;
    vec4 _e40 = read_ground_table(_e39);
    float _e42 = f_1;
    int _e43 = low_1;
    vec4 _e46 = read_ground_table((_e43 + 2));
    return (((_e25 * _e29) + (_e31 * _e35)) / ((_e38 * _e40) + (_e42 * _e46)));
}

vec4 radiance_again(int index_14, int first_point) {
    int ray_1 = 0;
    int i_2 = 0;
    int a_4 = 0;
    float mu_s_8 = 0.0;
    float nu_4 = 0.0;
    int first_1 = 0;
    int points_1 = 0;
    vec4 radiance_1 = vec4(0.0);
    float at_ground = 0.0;
    Several_i32_i32_i32_f32_f32_ _e11 = ray_and_star(index_14);
    ray_1 = _e11.v0_;
    i_2 = _e11.v1_;
    a_4 = _e11.v2_;
    mu_s_8 = _e11.v3_;
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
    int _e37 = ray_1;
    vec4 _e40 = read_shares_table((1 * _e37));
    int _e41 = first_1;
    int _e42 = points_1;
    int _e43 = first_1;
    float _e45 = mu_s_8;
    float _e46 = nu_4;
    float _e50 = _group_0_binding_0_fs.counts.z;
    float _e55 = _group_0_binding_0_fs.more_counts.x;
    vec4 _e57 = gathered(_e41, _e42, (_e43 - first_point), _e45, _e46, int(_e50), int(_e55));
    radiance_1 = (_e40 * _e57);
    int _e59 = a_4;
    float _e63 = _group_0_binding_0_fs.counts.y;
    int _e66 = whole_quotient(int(_e63), 2);
    if ((_e59 < _e66)) {
        int _e68 = i_2;
        int _e69 = a_4;
        float _e70 = mu_s_8;
        float _e71 = nu_4;
        float _e72 = star_at_end(_e68, _e69, _e70, _e71);
        at_ground = _e72;
        vec4 _e73 = radiance_1;
        int _e74 = ray_1;
        vec4 _e77 = read_reflections_table((1 * _e74));
        float _e78 = at_ground;
        float _e82 = _group_0_binding_0_fs.counts.z;
        vec4 _e84 = sky_at(_e78, int(_e82));
        radiance_1 = (_e73 + (_e77 * _e84));
    }
    vec4 _e87 = radiance_1;
    return _e87;
}

vec4 texel(int index_15) {
    float _e4 = _group_0_binding_1_fs.texels.z;
    vec4 _e6 = radiance_again(index_15, int(_e4));
    return _e6;
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_16 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first_2 = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_16, first_2), last));
    if (!((index_16 < first_2))) {
        local = (index_16 > last);
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
