#version 300 es
// of solver_reflection.wgsl 1f8709a531d01a53, by naga-wasm@30.1.0
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

float read_total(int index_1) {
    float _e5 = _group_0_binding_0_fs.total_start.x;
    ivec2 _e8 = texel_place((index_1 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_total(int axis) {
    float _e4 = _group_0_binding_0_fs.total_shape[axis];
    return int(_e4);
}

vec4 read_extinction(int index_2) {
    float _e5 = _group_0_binding_0_fs.extinction_start.x;
    ivec2 _e8 = texel_place((index_2 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_4_fs, _e8, 0);
    return _e10;
}

int size_extinction(int axis_1) {
    float _e4 = _group_0_binding_0_fs.extinction_shape[axis_1];
    return int(_e4);
}

vec4 read_albedo(int index_3) {
    float _e5 = _group_0_binding_0_fs.albedo_start.x;
    ivec2 _e8 = texel_place((index_3 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_4_fs, _e8, 0);
    return _e10;
}

int size_albedo(int axis_2) {
    float _e4 = _group_0_binding_0_fs.albedo_shape[axis_2];
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
            float _e18 = read_total((first + _e16));
            tau = (_e11 + (_e15 * _e18));
            int _e21 = c;
            c = (_e21 + 1);
            vec4 _e24 = tau;
            int _e25 = c;
            vec4 _e28 = read_extinction((1 * _e25));
            int _e29 = c;
            float _e31 = read_total((first + _e29));
            tau = (_e24 + (_e28 * _e31));
            int _e34 = c;
            c = (_e34 + 1);
            vec4 _e37 = tau;
            int _e38 = c;
            vec4 _e41 = read_extinction((1 * _e38));
            int _e42 = c;
            float _e44 = read_total((first + _e42));
            tau = (_e37 + (_e41 * _e44));
            int _e47 = c;
            c = (_e47 + 1);
            vec4 _e50 = tau;
            int _e51 = c;
            vec4 _e54 = read_extinction((1 * _e51));
            int _e55 = c;
            float _e57 = read_total((first + _e55));
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
            float _e72 = read_total((first + _e70));
            tau = (_e65 + (_e69 * _e72));
        }
    }
    vec4 _e78 = tau;
    return _e78;
}

vec4 reflected_share(int first_1, int constituents_1) {
    vec4 through = vec4(0.0);
    vec4 _e3 = optical_depth(first_1, constituents_1);
    through = exp((vec4(0.0) - _e3));
    vec4 _e9 = read_albedo(0);
    vec4 _e12 = through;
    return ((_e9 * 0.31830987) * _e12);
}

vec4 reflection(int index_4) {
    float _e4 = _group_0_binding_0_fs.counts.y;
    int _e6 = whole_rest(index_4, int(_e4));
    float _e10 = _group_0_binding_0_fs.counts.y;
    int _e13 = whole_quotient(int(_e10), 2);
    if ((_e6 >= _e13)) {
        return vec4(0.0);
    }
    float _e20 = _group_0_binding_0_fs.more_counts.z;
    float _e26 = _group_0_binding_0_fs.more_counts.z;
    vec4 _e28 = reflected_share((index_4 * int(_e20)), int(_e26));
    return _e28;
}

vec4 texel(int index_5) {
    vec4 _e1 = reflection(index_5);
    return _e1;
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_6 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first_2 = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_6, first_2), last));
    if (!((index_6 < first_2))) {
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
