#version 300 es
// of solver_projection.wgsl cf7e9aafd660d5f2, by naga-wasm@30.1.0
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

layout(location = 0) out vec4 _fs2p_location0;

ivec2 texel_place(int index) {
    return ivec2((index & 2047), (index >> 11u));
}

float read_mu(int index_1) {
    float _e5 = _group_0_binding_0_fs.mu_start.x;
    ivec2 _e8 = texel_place((index_1 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_mu(int axis) {
    float _e4 = _group_0_binding_0_fs.mu_shape[axis];
    return int(_e4);
}

float read_weight(int index_2) {
    float _e5 = _group_0_binding_0_fs.weight_start.x;
    ivec2 _e8 = texel_place((index_2 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_weight(int axis_1) {
    float _e4 = _group_0_binding_0_fs.weight_shape[axis_1];
    return int(_e4);
}

float read_flux(int index_3) {
    float _e5 = _group_0_binding_0_fs.flux_start.x;
    ivec2 _e8 = texel_place((index_3 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_flux(int axis_2) {
    float _e4 = _group_0_binding_0_fs.flux_shape[axis_2];
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
    float a_3 = abs(x_7);
    float b_2 = abs(y);
    float slope = (min(a_3, b_2) / max(max(a_3, b_2), 1e-37));
    bool steep = (slope > 0.41421357);
    float t = (steep ? ((slope - 1.0) / (slope + 1.0)) : slope);
    float z = (t * t);
    float tail_1 = (-0.3333295 + (z * (0.19977711 + (z * (-0.13877685 + (z * 0.080537446))))));
    float part = ((steep ? 0.7853982 : 0.0) + (t + ((t * z) * tail_1)));
    float quarter_2 = ((b_2 > a_3) ? (1.5707964 - part) : part);
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

int degree_of(int index_7) {
    return int(((0.5 * (sqrt(((8.0 * float(index_7)) + 1.0)) - 1.0)) + 0.001));
}

float climbed(float ahead, float back, float mu, float value, float before) {
    return (((ahead * mu) * value) - (back * before));
}

float legendre_function(float mu_1, int l, int m) {
    float sine_1_ = 0.0;
    float value_1 = 0.0;
    int order = 0;
    float before_1 = 0.0;
    int index_8 = 0;
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
    index_8 = (_e33 + m);
    step_1_ = (m + 1);
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e53 = step_1_;
            step_1_ = (_e53 + 1);
        }
        loop_init = false;
        int _e37 = step_1_;
        if ((_e37 < (l + 1))) {
        } else {
            break;
        }
        {
            int _e41 = index_8;
            int _e42 = step_1_;
            index_8 = (_e41 + _e42);
            int _e44 = index_8;
            float _e45 = read_ahead(_e44);
            int _e46 = index_8;
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

float projection(int index_9) {
    int rays = 0;
    int ray = 0;
    int term = 0;
    int i = 0;
    int a_2 = 0;
    int l_1 = 0;
    int m_1 = 0;
    float function = 0.0;
    float _e12 = _group_0_binding_0_fs.counts.x;
    float _e17 = _group_0_binding_0_fs.counts.y;
    rays = (int(_e12) * int(_e17));
    int _e20 = rays;
    float _e24 = _group_0_binding_0_fs.more_counts.y;
    if ((index_9 >= (_e20 * int(_e24)))) {
        int _e28 = rays;
        float _e32 = _group_0_binding_0_fs.more_counts.y;
        ray = (index_9 - (_e28 * int(_e32)));
        int _e36 = ray;
        float _e40 = _group_0_binding_0_fs.counts.y;
        int _e42 = whole_quotient(_e36, int(_e40));
        int _e44 = size_flux(1);
        int _e46 = ray;
        float _e50 = _group_0_binding_0_fs.counts.y;
        int _e52 = whole_rest(_e46, int(_e50));
        float _e54 = read_flux(((_e42 * _e44) + _e52));
        return _e54;
    }
    float _e58 = _group_0_binding_0_fs.more_counts.y;
    int _e60 = whole_quotient(index_9, int(_e58));
    float _e64 = _group_0_binding_0_fs.more_counts.y;
    int _e66 = whole_rest(index_9, int(_e64));
    ray = _e60;
    term = _e66;
    int _e67 = ray;
    float _e71 = _group_0_binding_0_fs.counts.y;
    int _e73 = whole_quotient(_e67, int(_e71));
    int _e74 = ray;
    float _e78 = _group_0_binding_0_fs.counts.y;
    int _e80 = whole_rest(_e74, int(_e78));
    i = _e73;
    a_2 = _e80;
    int _e81 = term;
    int _e82 = degree_of(_e81);
    l_1 = _e82;
    int _e83 = term;
    int _e84 = l_1;
    int _e85 = l_1;
    int _e90 = whole_quotient((_e84 * (_e85 + 1)), 2);
    m_1 = (_e83 - _e90);
    int _e92 = i;
    int _e94 = size_mu(1);
    int _e96 = a_2;
    float _e98 = read_mu(((_e92 * _e94) + _e96));
    int _e99 = l_1;
    int _e100 = m_1;
    float _e101 = legendre_function(_e98, _e99, _e100);
    function = _e101;
    int _e102 = i;
    int _e104 = size_weight(1);
    int _e106 = a_2;
    float _e108 = read_weight(((_e102 * _e104) + _e106));
    float _e109 = function;
    return (_e108 * _e109);
}

vec4 texel(int index_10) {
    float _e5 = projection(((4 * index_10) + 0));
    float _e10 = projection(((4 * index_10) + 1));
    float _e15 = projection(((4 * index_10) + 2));
    float _e20 = projection(((4 * index_10) + 3));
    return vec4(_e5, _e10, _e15, _e20);
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_11 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_11, first), last));
    if (!((index_11 < first))) {
        local = (index_11 > last);
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
