#version 300 es
// of solver_factor.wgsl b0645a9ed1844673, by naga-wasm@30.1.0
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

float read_mu_along(int index_1) {
    float _e5 = _group_0_binding_0_fs.mu_along_start.x;
    ivec2 _e8 = texel_place((index_1 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_mu_along(int axis) {
    float _e4 = _group_0_binding_0_fs.mu_along_shape[axis];
    return int(_e4);
}

float read_amount(int index_2) {
    float _e5 = _group_0_binding_0_fs.amount_start.x;
    ivec2 _e8 = texel_place((index_2 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_amount(int axis_1) {
    float _e4 = _group_0_binding_0_fs.amount_shape[axis_1];
    return int(_e4);
}

float read_column(int index_3) {
    float _e5 = _group_0_binding_0_fs.column_start.x;
    ivec2 _e8 = texel_place((index_3 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_column(int axis_2) {
    float _e4 = _group_0_binding_0_fs.column_shape[axis_2];
    return int(_e4);
}

float read_harmonic(int index_4) {
    float _e5 = _group_0_binding_0_fs.harmonic_start.x;
    ivec2 _e8 = texel_place((index_4 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_harmonic(int axis_3) {
    float _e4 = _group_0_binding_0_fs.harmonic_shape[axis_3];
    return int(_e4);
}

float read_ahead(int index_5) {
    float _e5 = _group_0_binding_0_fs.ahead_start.x;
    ivec2 _e8 = texel_place((index_5 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_ahead(int axis_4) {
    float _e4 = _group_0_binding_0_fs.ahead_shape[axis_4];
    return int(_e4);
}

float read_back(int index_6) {
    float _e5 = _group_0_binding_0_fs.back_start.x;
    ivec2 _e8 = texel_place((index_6 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_back(int axis_5) {
    float _e4 = _group_0_binding_0_fs.back_shape[axis_5];
    return int(_e4);
}

vec4 read_extinction(int index_7) {
    float _e5 = _group_0_binding_0_fs.extinction_start.x;
    ivec2 _e8 = texel_place((index_7 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_4_fs, _e8, 0);
    return _e10;
}

int size_extinction(int axis_6) {
    float _e4 = _group_0_binding_0_fs.extinction_shape[axis_6];
    return int(_e4);
}

vec4 read_moments(int index_8) {
    float _e5 = _group_0_binding_0_fs.moments_start.x;
    ivec2 _e8 = texel_place((index_8 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_4_fs, _e8, 0);
    return _e10;
}

int size_moments(int axis_7) {
    float _e4 = _group_0_binding_0_fs.moments_shape[axis_7];
    return int(_e4);
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

int degree_of(int index_9) {
    return int(((0.5 * (sqrt(((8.0 * float(index_9)) + 1.0)) - 1.0)) + 0.001));
}

vec4 optical_depth(int first, int constituents) {
    vec4 tau = vec4(0.0);
    int c = 0;
    tau = vec4(0.0);
    c = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e60 = c;
            c = (_e60 + 1);
        }
        loop_init = false;
        int _e7 = c;
        if (((_e7 + 3) < constituents)) {
        } else {
            break;
        }
        {
            vec4 _e11 = tau;
            int _e12 = c;
            vec4 _e15 = read_extinction((1 * _e12));
            int _e16 = c;
            float _e18 = read_column((first + _e16));
            tau = (_e11 + (_e15 * _e18));
            int _e21 = c;
            c = (_e21 + 1);
            vec4 _e24 = tau;
            int _e25 = c;
            vec4 _e28 = read_extinction((1 * _e25));
            int _e29 = c;
            float _e31 = read_column((first + _e29));
            tau = (_e24 + (_e28 * _e31));
            int _e34 = c;
            c = (_e34 + 1);
            vec4 _e37 = tau;
            int _e38 = c;
            vec4 _e41 = read_extinction((1 * _e38));
            int _e42 = c;
            float _e44 = read_column((first + _e42));
            tau = (_e37 + (_e41 * _e44));
            int _e47 = c;
            c = (_e47 + 1);
            vec4 _e50 = tau;
            int _e51 = c;
            vec4 _e54 = read_extinction((1 * _e51));
            int _e55 = c;
            float _e57 = read_column((first + _e55));
            tau = (_e50 + (_e54 * _e57));
        }
    }
    bool loop_init_1 = true;
    while(true) {
        if (!loop_init_1) {
            int _e75 = c;
            c = (_e75 + 1);
        }
        loop_init_1 = false;
        int _e63 = c;
        if ((_e63 < constituents)) {
        } else {
            break;
        }
        {
            vec4 _e65 = tau;
            int _e66 = c;
            vec4 _e69 = read_extinction((1 * _e66));
            int _e70 = c;
            float _e72 = read_column((first + _e70));
            tau = (_e65 + (_e69 * _e72));
        }
    }
    vec4 _e78 = tau;
    return _e78;
}

vec4 strength_of(int point, int l, int degree, int constituents_1) {
    vec4 strength = vec4(0.0);
    int c_1 = 0;
    strength = vec4(0.0);
    c_1 = 0;
    bool loop_init_2 = true;
    while(true) {
        if (!loop_init_2) {
            int _e90 = c_1;
            c_1 = (_e90 + 1);
        }
        loop_init_2 = false;
        int _e9 = c_1;
        if (((_e9 + 3) < constituents_1)) {
        } else {
            break;
        }
        {
            vec4 _e13 = strength;
            int _e14 = c_1;
            vec4 _e21 = read_moments((1 * ((_e14 * (degree + 1)) + l)));
            int _e23 = size_amount(1);
            int _e25 = c_1;
            float _e27 = read_amount(((point * _e23) + _e25));
            strength = (_e13 + (_e21 * _e27));
            int _e30 = c_1;
            c_1 = (_e30 + 1);
            vec4 _e33 = strength;
            int _e34 = c_1;
            vec4 _e41 = read_moments((1 * ((_e34 * (degree + 1)) + l)));
            int _e43 = size_amount(1);
            int _e45 = c_1;
            float _e47 = read_amount(((point * _e43) + _e45));
            strength = (_e33 + (_e41 * _e47));
            int _e50 = c_1;
            c_1 = (_e50 + 1);
            vec4 _e53 = strength;
            int _e54 = c_1;
            vec4 _e61 = read_moments((1 * ((_e54 * (degree + 1)) + l)));
            int _e63 = size_amount(1);
            int _e65 = c_1;
            float _e67 = read_amount(((point * _e63) + _e65));
            strength = (_e53 + (_e61 * _e67));
            int _e70 = c_1;
            c_1 = (_e70 + 1);
            vec4 _e73 = strength;
            int _e74 = c_1;
            vec4 _e81 = read_moments((1 * ((_e74 * (degree + 1)) + l)));
            int _e83 = size_amount(1);
            int _e85 = c_1;
            float _e87 = read_amount(((point * _e83) + _e85));
            strength = (_e73 + (_e81 * _e87));
        }
    }
    bool loop_init_3 = true;
    while(true) {
        if (!loop_init_3) {
            int _e112 = c_1;
            c_1 = (_e112 + 1);
        }
        loop_init_3 = false;
        int _e93 = c_1;
        if ((_e93 < constituents_1)) {
        } else {
            break;
        }
        {
            vec4 _e95 = strength;
            int _e96 = c_1;
            vec4 _e103 = read_moments((1 * ((_e96 * (degree + 1)) + l)));
            int _e105 = size_amount(1);
            int _e107 = c_1;
            float _e109 = read_amount(((point * _e105) + _e107));
            strength = (_e95 + (_e103 * _e109));
        }
    }
    vec4 _e115 = strength;
    return _e115;
}

float climbed(float ahead, float back, float mu, float value, float before) {
    return (((ahead * mu) * value) - (back * before));
}

float legendre_function(float mu_1, int l_1, int m) {
    float sine_1_ = 0.0;
    float value_1 = 0.0;
    int order = 0;
    float before_1 = 0.0;
    int index_10 = 0;
    int step_1_ = 0;
    float following = 0.0;
    sine_1_ = sqrt(max(((1.0 - mu_1) * (1.0 + mu_1)), 0.0));
    float _e18 = read_harmonic(m);
    value_1 = _e18;
    order = 0;
    while(true) {
        int _e20 = order;
        if ((_e20 < m)) {
        } else {
            break;
        }
        {
            float _e22 = value_1;
            float _e23 = sine_1_;
            value_1 = (_e22 * _e23);
            int _e25 = order;
            order = (_e25 + 1);
        }
    }
    before_1 = 0.0;
    int _e33 = whole_quotient((m * (m + 1)), 2);
    index_10 = (_e33 + m);
    step_1_ = (m + 1);
    bool loop_init_4 = true;
    while(true) {
        if (!loop_init_4) {
            int _e53 = step_1_;
            step_1_ = (_e53 + 1);
        }
        loop_init_4 = false;
        int _e37 = step_1_;
        if ((_e37 < (l_1 + 1))) {
        } else {
            break;
        }
        {
            int _e41 = index_10;
            int _e42 = step_1_;
            index_10 = (_e41 + _e42);
            int _e44 = index_10;
            float _e45 = read_ahead(_e44);
            int _e46 = index_10;
            float _e47 = read_back(_e46);
            float _e48 = value_1;
            float _e49 = before_1;
            float _e50 = climbed(_e45, _e47, mu_1, _e48, _e49);
            following = _e50;
            float _e51 = value_1;
            before_1 = _e51;
            float _e52 = following;
            value_1 = _e52;
        }
    }
    float _e56 = value_1;
    return _e56;
}

vec4 factor(int index_11) {
    int point_1 = 0;
    int term = 0;
    int l_2 = 0;
    int m_1 = 0;
    vec4 depth = vec4(0.0);
    vec4 scattered = vec4(0.0);
    float function = 0.0;
    float _e11 = _group_0_binding_0_fs.more_counts.y;
    int _e13 = whole_quotient(index_11, int(_e11));
    float _e17 = _group_0_binding_0_fs.more_counts.y;
    int _e19 = whole_rest(index_11, int(_e17));
    point_1 = _e13;
    term = _e19;
    int _e20 = term;
    int _e21 = degree_of(_e20);
    l_2 = _e21;
    int _e22 = term;
    int _e23 = l_2;
    int _e24 = l_2;
    int _e29 = whole_quotient((_e23 * (_e24 + 1)), 2);
    m_1 = (_e22 - _e29);
    int _e31 = point_1;
    float _e35 = _group_0_binding_0_fs.more_counts.z;
    float _e41 = _group_0_binding_0_fs.more_counts.z;
    vec4 _e43 = optical_depth((_e31 * int(_e35)), int(_e41));
    depth = _e43;
    int _e44 = point_1;
    int _e45 = l_2;
    float _e49 = _group_0_binding_0_fs.more_counts.x;
    float _e54 = _group_0_binding_0_fs.more_counts.z;
    vec4 _e56 = strength_of(_e44, _e45, int(_e49), int(_e54));
    scattered = _e56;
    int _e57 = point_1;
    float _e58 = read_mu_along(_e57);
    int _e59 = l_2;
    int _e60 = m_1;
    float _e61 = legendre_function(_e58, _e59, _e60);
    function = _e61;
    vec4 _e62 = depth;
    vec4 _e67 = scattered;
    float _e69 = function;
    return ((exp((vec4(0.0) - _e62)) * _e67) * _e69);
}

vec4 texel(int index_12) {
    vec4 _e1 = factor(index_12);
    return _e1;
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_13 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first_1 = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_13, first_1), last));
    if (!((index_13 < first_1))) {
        local = (index_13 > last);
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
