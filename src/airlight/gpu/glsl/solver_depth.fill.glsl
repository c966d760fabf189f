#version 300 es
// of solver_depth.wgsl 2619124bf62b0ea4, by naga-wasm@30.1.0
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

float read_radius(int index_1) {
    float _e5 = _group_0_binding_0_fs.radius_start.x;
    ivec2 _e8 = texel_place((index_1 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_radius(int axis) {
    float _e4 = _group_0_binding_0_fs.radius_shape[axis];
    return int(_e4);
}

float read_row(int index_2) {
    float _e5 = _group_0_binding_0_fs.row_start.x;
    ivec2 _e8 = texel_place((index_2 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_row(int axis_1) {
    float _e4 = _group_0_binding_0_fs.row_shape[axis_1];
    return int(_e4);
}

float read_ratios(int index_3) {
    float _e5 = _group_0_binding_0_fs.ratios_start.x;
    ivec2 _e8 = texel_place((index_3 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_3_fs, _e8, 0);
    return _e10.x;
}

int size_ratios(int axis_2) {
    float _e4 = _group_0_binding_0_fs.ratios_shape[axis_2];
    return int(_e4);
}

vec4 read_extinction(int index_4) {
    float _e5 = _group_0_binding_0_fs.extinction_start.x;
    ivec2 _e8 = texel_place((index_4 + int(_e5)));
    vec4 _e10 = texelFetch(_group_0_binding_4_fs, _e8, 0);
    return _e10;
}

int size_extinction(int axis_3) {
    float _e4 = _group_0_binding_0_fs.extinction_shape[axis_3];
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

float altitude_coordinate(float r, float bottom_radius, float top_radius) {
    float tangent = 0.0;
    tangent = sqrt(((top_radius - bottom_radius) * (top_radius + bottom_radius)));
    float _e14 = tangent;
    return (sqrt(max(((r - bottom_radius) * (r + bottom_radius)), 0.0)) / _e14);
}

vec4 depth_towards(int row, float f, int place, float distance_1_, int constituents) {
    vec4 tau = vec4(0.0);
    int c = 0;
    float scale = 0.0;
    float scaled = 0.0;
    tau = vec4(0.0);
    c = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e365 = c;
            c = (_e365 + 1);
        }
        loop_init = false;
        int _e12 = c;
        if (((_e12 + 3) < constituents)) {
        } else {
            break;
        }
        {
            int _e17 = size_ratios(1);
            int _e21 = size_ratios(2);
            int _e23 = c;
            int _e26 = size_ratios(3);
            float _e30 = read_ratios(((((((row * _e17) + place) * _e21) + _e23) * _e26) + 0));
            int _e37 = size_ratios(1);
            int _e41 = size_ratios(2);
            int _e43 = c;
            int _e46 = size_ratios(3);
            float _e50 = read_ratios((((((((row + 1) * _e37) + place) * _e41) + _e43) * _e46) + 0));
            scale = ((_e30 * (1.0 - f)) + (_e50 * f));
            int _e54 = size_ratios(1);
            int _e58 = size_ratios(2);
            int _e60 = c;
            int _e63 = size_ratios(3);
            float _e67 = read_ratios(((((((row * _e54) + place) * _e58) + _e60) * _e63) + 1));
            int _e74 = size_ratios(1);
            int _e78 = size_ratios(2);
            int _e80 = c;
            int _e83 = size_ratios(3);
            float _e87 = read_ratios((((((((row + 1) * _e74) + place) * _e78) + _e80) * _e83) + 1));
            scaled = ((_e67 * (1.0 - f)) + (_e87 * f));
            vec4 _e90 = tau;
            int _e91 = c;
            vec4 _e94 = read_extinction((1 * _e91));
            float _e95 = scaled;
            float _e97 = scale;
            tau = (_e90 + (_e94 * ((distance_1_ * _e95) / _e97)));
            int _e101 = c;
            c = (_e101 + 1);
            int _e105 = size_ratios(1);
            int _e109 = size_ratios(2);
            int _e111 = c;
            int _e114 = size_ratios(3);
            float _e118 = read_ratios(((((((row * _e105) + place) * _e109) + _e111) * _e114) + 0));
            int _e125 = size_ratios(1);
            int _e129 = size_ratios(2);
            int _e131 = c;
            int _e134 = size_ratios(3);
            float _e138 = read_ratios((((((((row + 1) * _e125) + place) * _e129) + _e131) * _e134) + 0));
            scale = ((_e118 * (1.0 - f)) + (_e138 * f));
            int _e142 = size_ratios(1);
            int _e146 = size_ratios(2);
            int _e148 = c;
            int _e151 = size_ratios(3);
            float _e155 = read_ratios(((((((row * _e142) + place) * _e146) + _e148) * _e151) + 1));
            int _e162 = size_ratios(1);
            int _e166 = size_ratios(2);
            int _e168 = c;
            int _e171 = size_ratios(3);
            float _e175 = read_ratios((((((((row + 1) * _e162) + place) * _e166) + _e168) * _e171) + 1));
            scaled = ((_e155 * (1.0 - f)) + (_e175 * f));
            vec4 _e178 = tau;
            int _e179 = c;
            vec4 _e182 = read_extinction((1 * _e179));
            float _e183 = scaled;
            float _e185 = scale;
            tau = (_e178 + (_e182 * ((distance_1_ * _e183) / _e185)));
            int _e189 = c;
            c = (_e189 + 1);
            int _e193 = size_ratios(1);
            int _e197 = size_ratios(2);
            int _e199 = c;
            int _e202 = size_ratios(3);
            float _e206 = read_ratios(((((((row * _e193) + place) * _e197) + _e199) * _e202) + 0));
            int _e213 = size_ratios(1);
            int _e217 = size_ratios(2);
            int _e219 = c;
            int _e222 = size_ratios(3);
            float _e226 = read_ratios((((((((row + 1) * _e213) + place) * _e217) + _e219) * _e222) + 0));
            scale = ((_e206 * (1.0 - f)) + (_e226 * f));
            int _e230 = size_ratios(1);
            int _e234 = size_ratios(2);
            int _e236 = c;
            int _e239 = size_ratios(3);
            float _e243 = read_ratios(((((((row * _e230) + place) * _e234) + _e236) * _e239) + 1));
            int _e250 = size_ratios(1);
            int _e254 = size_ratios(2);
            int _e256 = c;
            int _e259 = size_ratios(3);
            float _e263 = read_ratios((((((((row + 1) * _e250) + place) * _e254) + _e256) * _e259) + 1));
            scaled = ((_e243 * (1.0 - f)) + (_e263 * f));
            vec4 _e266 = tau;
            int _e267 = c;
            vec4 _e270 = read_extinction((1 * _e267));
            float _e271 = scaled;
            float _e273 = scale;
            tau = (_e266 + (_e270 * ((distance_1_ * _e271) / _e273)));
            int _e277 = c;
            c = (_e277 + 1);
            int _e281 = size_ratios(1);
            int _e285 = size_ratios(2);
            int _e287 = c;
            int _e290 = size_ratios(3);
            float _e294 = read_ratios(((((((row * _e281) + place) * _e285) + _e287) * _e290) + 0));
            int _e301 = size_ratios(1);
            int _e305 = size_ratios(2);
            int _e307 = c;
            int _e310 = size_ratios(3);
            float _e314 = read_ratios((((((((row + 1) * _e301) + place) * _e305) + _e307) * _e310) + 0));
            scale = ((_e294 * (1.0 - f)) + (_e314 * f));
            int _e318 = size_ratios(1);
            int _e322 = size_ratios(2);
            int _e324 = c;
            int _e327 = size_ratios(3);
            float _e331 = read_ratios(((((((row * _e318) + place) * _e322) + _e324) * _e327) + 1));
            int _e338 = size_ratios(1);
            int _e342 = size_ratios(2);
            int _e344 = c;
            int _e347 = size_ratios(3);
            float _e351 = read_ratios((((((((row + 1) * _e338) + place) * _e342) + _e344) * _e347) + 1));
            scaled = ((_e331 * (1.0 - f)) + (_e351 * f));
            vec4 _e354 = tau;
            int _e355 = c;
            vec4 _e358 = read_extinction((1 * _e355));
            float _e359 = scaled;
            float _e361 = scale;
            tau = (_e354 + (_e358 * ((distance_1_ * _e359) / _e361)));
        }
    }
    bool loop_init_1 = true;
    while(true) {
        if (!loop_init_1) {
            int _e455 = c;
            c = (_e455 + 1);
        }
        loop_init_1 = false;
        int _e368 = c;
        if ((_e368 < constituents)) {
        } else {
            break;
        }
        {
            int _e371 = size_ratios(1);
            int _e375 = size_ratios(2);
            int _e377 = c;
            int _e380 = size_ratios(3);
            float _e384 = read_ratios(((((((row * _e371) + place) * _e375) + _e377) * _e380) + 0));
            int _e391 = size_ratios(1);
            int _e395 = size_ratios(2);
            int _e397 = c;
            int _e400 = size_ratios(3);
            float _e404 = read_ratios((((((((row + 1) * _e391) + place) * _e395) + _e397) * _e400) + 0));
            scale = ((_e384 * (1.0 - f)) + (_e404 * f));
            int _e408 = size_ratios(1);
            int _e412 = size_ratios(2);
            int _e414 = c;
            int _e417 = size_ratios(3);
            float _e421 = read_ratios(((((((row * _e408) + place) * _e412) + _e414) * _e417) + 1));
            int _e428 = size_ratios(1);
            int _e432 = size_ratios(2);
            int _e434 = c;
            int _e437 = size_ratios(3);
            float _e441 = read_ratios((((((((row + 1) * _e428) + place) * _e432) + _e434) * _e437) + 1));
            scaled = ((_e421 * (1.0 - f)) + (_e441 * f));
            vec4 _e444 = tau;
            int _e445 = c;
            vec4 _e448 = read_extinction((1 * _e445));
            float _e449 = scaled;
            float _e451 = scale;
            tau = (_e444 + (_e448 * ((distance_1_ * _e449) / _e451)));
        }
    }
    vec4 _e458 = tau;
    return _e458;
}

vec4 depth_in_row(float q, int place_1, float bottom, float top, int constituents_1) {
    float x_11 = 0.0;
    int row_1 = 0;
    float f_1 = 0.0;
    float shortest = 0.0;
    float longest = 0.0;
    float distance_1_1 = 0.0;
    float _e11 = altitude_coordinate(q, bottom, top);
    x_11 = _e11;
    float _e12 = x_11;
    int _e14 = size_ratios(0);
    int _e21 = size_ratios(0);
    row_1 = min(int((_e12 * float((_e14 - 1)))), (_e21 - 2));
    float _e25 = x_11;
    int _e27 = size_ratios(0);
    int _e32 = row_1;
    f_1 = ((_e25 * float((_e27 - 1))) - float(_e32));
    shortest = (top - q);
    float _e36 = x_11;
    longest = ((1.0 + _e36) * sqrt(((top - bottom) * (top + bottom))));
    float _e44 = shortest;
    float _e46 = longest;
    float _e47 = shortest;
    int _e50 = size_ratios(1);
    distance_1_1 = (_e44 + (float(place_1) * ((_e46 - _e47) / float((_e50 - 1)))));
    int _e57 = row_1;
    float _e58 = f_1;
    float _e59 = distance_1_1;
    vec4 _e60 = depth_towards(_e57, _e58, place_1, _e59, constituents_1);
    return _e60;
}

vec4 depth(int index_5, int first_point) {
    int local_3 = 0;
    int place_2 = 0;
    float q_1 = 0.0;
    float _e8 = _group_0_binding_0_fs.more_counts.w;
    int _e10 = whole_quotient(index_5, int(_e8));
    float _e14 = _group_0_binding_0_fs.more_counts.w;
    int _e16 = whole_rest(index_5, int(_e14));
    local_3 = _e10;
    place_2 = _e16;
    float _e20 = _group_0_binding_0_fs.measures.x;
    q_1 = _e20;
    int _e21 = local_3;
    if ((_e21 > 0)) {
        int _e24 = local_3;
        float _e28 = read_radius(((first_point + _e24) - 1));
        q_1 = _e28;
    }
    float _e29 = q_1;
    int _e30 = place_2;
    float _e34 = _group_0_binding_0_fs.measures.x;
    float _e38 = _group_0_binding_0_fs.measures.y;
    float _e42 = _group_0_binding_0_fs.more_counts.z;
    vec4 _e44 = depth_in_row(_e29, _e30, _e34, _e38, int(_e42));
    return _e44;
}

vec4 texel(int index_6) {
    float _e4 = _group_0_binding_1_fs.texels.z;
    vec4 _e6 = depth(index_6, int(_e4));
    return _e6;
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_7 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_7, first), last));
    if (!((index_7 < first))) {
        local = (index_7 > last);
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
