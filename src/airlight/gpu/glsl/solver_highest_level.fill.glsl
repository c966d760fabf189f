#version 300 es
// of solver_highest_level.wgsl 575b29ce4505244d, by naga-wasm@30.1.0
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

int size_level(int axis) {
    float _e4 = _group_0_binding_0_fs.level_shape[axis];
    return int(_e4);
}

float read_fine_table(int index_2) {
    ivec2 _e4 = texel_place((index_2 >> 2u));
    vec4 _e6 = texelFetch(_group_0_binding_3_fs, _e4, 0);
    return _e6[(index_2 & 3)];
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

float largest_of(int index_3, int count) {
    int lane = 0;
    int j = 0;
    int step_1_ = 0;
    int start = 0;
    float largest = 0.0;
    int i = 0;
    int _e9 = whole_rest(index_3, 4);
    lane = _e9;
    int _e11 = whole_quotient(index_3, 4);
    float _e15 = _group_0_binding_0_fs.counts.z;
    int _e17 = whole_rest(_e11, int(_e15));
    j = _e17;
    float _e21 = _group_0_binding_0_fs.more_counts.y;
    step_1_ = (int(_e21) * 4);
    start = 0;
    float _e29 = _group_0_binding_0_fs.counts.z;
    if ((index_3 >= (int(_e29) * 4))) {
        float _e37 = _group_0_binding_0_fs.counts.z;
        int _e40 = step_1_;
        start = ((count * int(_e37)) * _e40);
        step_1_ = 4;
    }
    largest = 0.0;
    i = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e130 = i;
            i = (_e130 + 1);
        }
        loop_init = false;
        int _e45 = i;
        if (((_e45 + 3) < count)) {
        } else {
            break;
        }
        {
            float _e49 = largest;
            int _e50 = start;
            int _e51 = i;
            float _e55 = _group_0_binding_0_fs.counts.z;
            int _e58 = j;
            int _e60 = step_1_;
            int _e63 = lane;
            float _e65 = read_fine_table(((_e50 + (((_e51 * int(_e55)) + _e58) * _e60)) + _e63));
            largest = max(_e49, _e65);
            int _e67 = i;
            i = (_e67 + 1);
            float _e70 = largest;
            int _e71 = start;
            int _e72 = i;
            float _e76 = _group_0_binding_0_fs.counts.z;
            int _e79 = j;
            int _e81 = step_1_;
            int _e84 = lane;
            float _e86 = read_fine_table(((_e71 + (((_e72 * int(_e76)) + _e79) * _e81)) + _e84));
            largest = max(_e70, _e86);
            int _e88 = i;
            i = (_e88 + 1);
            float _e91 = largest;
            int _e92 = start;
            int _e93 = i;
            float _e97 = _group_0_binding_0_fs.counts.z;
            int _e100 = j;
            int _e102 = step_1_;
            int _e105 = lane;
            float _e107 = read_fine_table(((_e92 + (((_e93 * int(_e97)) + _e100) * _e102)) + _e105));
            largest = max(_e91, _e107);
            int _e109 = i;
            i = (_e109 + 1);
            float _e112 = largest;
            int _e113 = start;
            int _e114 = i;
            float _e118 = _group_0_binding_0_fs.counts.z;
            int _e121 = j;
            int _e123 = step_1_;
            int _e126 = lane;
            float _e128 = read_fine_table(((_e113 + (((_e114 * int(_e118)) + _e121) * _e123)) + _e126));
            largest = max(_e112, _e128);
        }
    }
    bool loop_init_1 = true;
    while(true) {
        if (!loop_init_1) {
            int _e153 = i;
            i = (_e153 + 1);
        }
        loop_init_1 = false;
        int _e133 = i;
        if ((_e133 < count)) {
        } else {
            break;
        }
        {
            float _e135 = largest;
            int _e136 = start;
            int _e137 = i;
            float _e141 = _group_0_binding_0_fs.counts.z;
            int _e144 = j;
            int _e146 = step_1_;
            int _e149 = lane;
            float _e151 = read_fine_table(((_e136 + (((_e137 * int(_e141)) + _e144) * _e146)) + _e149));
            largest = max(_e135, _e151);
        }
    }
    float _e156 = largest;
    return _e156;
}

float highest_level(int index_4) {
    float _e4 = _group_0_binding_0_fs.most_counts.x;
    float _e6 = largest_of(index_4, int(_e4));
    return _e6;
}

vec4 texel(int index_5) {
    float _e5 = highest_level(((4 * index_5) + 0));
    float _e10 = highest_level(((4 * index_5) + 1));
    float _e15 = highest_level(((4 * index_5) + 2));
    float _e20 = highest_level(((4 * index_5) + 3));
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
