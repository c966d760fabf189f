#version 300 es
// of solver_row.wgsl db1b1d08d227fc9c, by naga-wasm@30.1.0
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

float read_radius(int index_1) {
    float _e5 = _group_0_binding_0_fs.radius_start.x;
    ivec2 _e8 = texel_place((index_1 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_5_fs, _e8, 0);
    return _e10.x;
}

int size_radius(int axis) {
    float _e4 = _group_0_binding_0_fs.radius_shape[axis];
    return int(_e4);
}

float read_row(int index_2) {
    float _e5 = _group_0_binding_0_fs.row_start.x;
    ivec2 _e8 = texel_place((index_2 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_5_fs, _e8, 0);
    return _e10.x;
}

int size_row(int axis_1) {
    float _e4 = _group_0_binding_0_fs.row_shape[axis_1];
    return int(_e4);
}

vec4 read_factors_table(int index_3) {
    ivec2 _e2 = texel_place(index_3);
    vec4 _e4 = texelFetch(_group_0_binding_3_fs, _e2, 0);
    return _e4;
}

vec4 read_packed_table(int index_4) {
    ivec2 _e2 = texel_place(index_4);
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

float row_of(float q, float bottom, float top) {
    float fraction = 0.0;
    float x_11 = 0.0;
    int k = 0;
    fraction = min(max(((q - bottom) / (top - bottom)), 0.0), 1.0);
    float _e13 = fraction;
    int _e16 = size_row(0);
    x_11 = (sqrt(_e13) * float((_e16 - 1)));
    float _e21 = x_11;
    int _e24 = size_row(0);
    k = min(int(_e21), (_e24 - 2));
    int _e28 = k;
    float _e29 = read_row(_e28);
    int _e30 = k;
    float _e33 = read_row((_e30 + 1));
    int _e34 = k;
    float _e35 = read_row(_e34);
    float _e37 = x_11;
    int _e38 = k;
    return (_e29 + ((_e33 - _e35) * (_e37 - float(_e38))));
}

vec4 contracted(int first, int low, int high, float f, int m, int degree) {
    float g = 0.0;
    vec4 total = vec4(0.0);
    int l = 0;
    int index_5 = 0;
    int at = 0;
    g = (1.0 - f);
    total = vec4(0.0);
    int end_1_ = (degree + 1);
    l = m;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e154 = l;
            l = (_e154 + 1);
        }
        loop_init = false;
        int _e17 = l;
        if (((_e17 + 3) < end_1_)) {
        } else {
            break;
        }
        {
            int _e21 = l;
            int _e22 = l;
            int _e27 = whole_quotient((_e21 * (_e22 + 1)), 2);
            index_5 = (_e27 + m);
            int _e29 = index_5;
            at = (1 * (1 + _e29));
            vec4 _e34 = total;
            int _e35 = index_5;
            vec4 _e39 = read_factors_table((first + (1 * _e35)));
            float _e40 = g;
            int _e41 = at;
            vec4 _e43 = read_packed_table((low + _e41));
            int _e45 = at;
            vec4 _e47 = read_packed_table((high + _e45));
            total = (_e34 + (_e39 * ((_e40 * _e43) + (f * _e47))));
            int _e52 = l;
            l = (_e52 + 1);
            int _e55 = l;
            int _e56 = l;
            int _e61 = whole_quotient((_e55 * (_e56 + 1)), 2);
            index_5 = (_e61 + m);
            int _e63 = index_5;
            at = (1 * (1 + _e63));
            vec4 _e68 = total;
            int _e69 = index_5;
            vec4 _e73 = read_factors_table((first + (1 * _e69)));
            float _e74 = g;
            int _e75 = at;
            vec4 _e77 = read_packed_table((low + _e75));
            int _e79 = at;
            vec4 _e81 = read_packed_table((high + _e79));
            total = (_e68 + (_e73 * ((_e74 * _e77) + (f * _e81))));
            int _e86 = l;
            l = (_e86 + 1);
            int _e89 = l;
            int _e90 = l;
            int _e95 = whole_quotient((_e89 * (_e90 + 1)), 2);
            index_5 = (_e95 + m);
            int _e97 = index_5;
            at = (1 * (1 + _e97));
            vec4 _e102 = total;
            int _e103 = index_5;
            vec4 _e107 = read_factors_table((first + (1 * _e103)));
            float _e108 = g;
            int _e109 = at;
            vec4 _e111 = read_packed_table((low + _e109));
            int _e113 = at;
            vec4 _e115 = read_packed_table((high + _e113));
            total = (_e102 + (_e107 * ((_e108 * _e111) + (f * _e115))));
            int _e120 = l;
            l = (_e120 + 1);
            int _e123 = l;
            int _e124 = l;
            int _e129 = whole_quotient((_e123 * (_e124 + 1)), 2);
            index_5 = (_e129 + m);
            int _e131 = index_5;
            at = (1 * (1 + _e131));
            vec4 _e136 = total;
            int _e137 = index_5;
            vec4 _e141 = read_factors_table((first + (1 * _e137)));
            float _e142 = g;
            int _e143 = at;
            vec4 _e145 = read_packed_table((low + _e143));
            int _e147 = at;
            vec4 _e149 = read_packed_table((high + _e147));
            total = (_e136 + (_e141 * ((_e142 * _e145) + (f * _e149))));
        }
    }
    bool loop_init_1 = true;
    while(true) {
        if (!loop_init_1) {
            int _e190 = l;
            l = (_e190 + 1);
        }
        loop_init_1 = false;
        int _e157 = l;
        if ((_e157 < end_1_)) {
        } else {
            break;
        }
        {
            int _e159 = l;
            int _e160 = l;
            int _e165 = whole_quotient((_e159 * (_e160 + 1)), 2);
            index_5 = (_e165 + m);
            int _e167 = index_5;
            at = (1 * (1 + _e167));
            vec4 _e172 = total;
            int _e173 = index_5;
            vec4 _e177 = read_factors_table((first + (1 * _e173)));
            float _e178 = g;
            int _e179 = at;
            vec4 _e181 = read_packed_table((low + _e179));
            int _e183 = at;
            vec4 _e185 = read_packed_table((high + _e183));
            total = (_e172 + (_e177 * ((_e178 * _e181) + (f * _e185))));
        }
    }
    vec4 _e193 = total;
    return _e193;
}

vec4 row(int index_6, int first_point) {
    int block = 0;
    int part = 0;
    int j = 0;
    int point = 0;
    float x_12 = 0.0;
    int level = 0;
    float f_1 = 0.0;
    int low_1 = 0;
    int high_1 = 0;
    float _e14 = _group_0_binding_0_fs.more_counts.x;
    block = (int(_e14) + 2);
    int _e18 = block;
    int _e19 = whole_rest(index_6, _e18);
    part = _e19;
    int _e20 = block;
    int _e21 = whole_quotient(index_6, _e20);
    float _e25 = _group_0_binding_0_fs.counts.z;
    int _e27 = whole_rest(_e21, int(_e25));
    j = _e27;
    int _e28 = block;
    float _e32 = _group_0_binding_0_fs.counts.z;
    int _e35 = whole_quotient(index_6, (_e28 * int(_e32)));
    point = (first_point + _e35);
    int _e37 = point;
    float _e38 = read_radius(_e37);
    float _e42 = _group_0_binding_0_fs.measures.x;
    float _e46 = _group_0_binding_0_fs.measures.y;
    float _e47 = row_of(_e38, _e42, _e46);
    x_12 = _e47;
    float _e48 = x_12;
    float _e53 = _group_0_binding_0_fs.most_counts.x;
    level = min(int(_e48), (int(_e53) - 2));
    float _e58 = x_12;
    int _e59 = level;
    f_1 = (_e58 - float(_e59));
    int _e62 = level;
    float _e66 = _group_0_binding_0_fs.counts.z;
    int _e69 = j;
    float _e74 = _group_0_binding_0_fs.more_counts.y;
    low_1 = ((((_e62 * int(_e66)) + _e69) * (1 + int(_e74))) * 1);
    int _e81 = low_1;
    float _e85 = _group_0_binding_0_fs.counts.z;
    float _e90 = _group_0_binding_0_fs.more_counts.y;
    high_1 = (_e81 + ((int(_e85) * (1 + int(_e90))) * 1));
    int _e98 = part;
    if ((_e98 == 0)) {
        float _e101 = f_1;
        int _e104 = low_1;
        vec4 _e105 = read_packed_table(_e104);
        float _e107 = f_1;
        int _e108 = high_1;
        vec4 _e109 = read_packed_table(_e108);
        return (((1.0 - _e101) * _e105) + (_e107 * _e109));
    }
    int _e112 = point;
    float _e118 = _group_0_binding_0_fs.more_counts.y;
    int _e121 = low_1;
    int _e122 = high_1;
    float _e123 = f_1;
    int _e124 = part;
    float _e130 = _group_0_binding_0_fs.more_counts.x;
    vec4 _e132 = contracted(((1 * _e112) * int(_e118)), _e121, _e122, _e123, (_e124 - 1), int(_e130));
    return _e132;
}

vec4 texel(int index_7) {
    float _e4 = _group_0_binding_1_fs.texels.z;
    vec4 _e6 = row(index_7, int(_e4));
    return _e6;
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_8 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first_1 = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_8, first_1), last));
    if (!((index_8 < first_1))) {
        local = (index_8 > last);
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
