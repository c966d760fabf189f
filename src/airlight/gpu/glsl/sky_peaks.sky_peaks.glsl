#version 300 es
// of sky_peaks.wgsl c06c0abcb382e085, by naga-wasm@30.1.0
precision highp float;
precision highp int;

struct Frame {
    vec4 shell;
    vec4 counts;
    vec4 peaks;
    vec4 observer;
    vec4 star;
    vec4 screen;
    vec4 camera_right;
    vec4 camera_up;
    vec4 camera_forward;
    vec4 planet_x;
    vec4 planet_y;
    vec4 planet_z;
    vec4 red;
    vec4 green;
    vec4 blue;
    vec4 display;
    vec4 sky;
    vec4 table_columns;
    vec4 table_density;
    vec4 table_strongest;
    vec4 table_brightest;
    vec4 table_lift;
    vec4 table_ends;
    vec4 table_row;
    vec4 table_place;
    vec4 table_start;
    vec4 table_ahead;
    vec4 table_back;
    vec4 table_rules;
    vec4 table_extinction;
    vec4 table_scattering;
    vec4 table_moments;
    vec4 table_albedo;
    vec4 table_phase;
    vec4 table_basis;
    vec4 table_field;
    vec4 table_sky;
    vec4 table_levels;
    vec4 table_texels;
};
struct Layers {
    vec4 first;
    vec4 second;
};
struct Several_f32_f32_ {
    float v0_;
    float v1_;
};
struct Several_bool_f32_f32_f32_f32_ {
    bool v0_;
    float v1_;
    float v2_;
    float v3_;
    float v4_;
};
struct Several_f32_f32_f32_ {
    float v0_;
    float v1_;
    float v2_;
};
struct Several_i32_f32_ {
    int v0_;
    float v1_;
};
layout(std140) uniform Frame_block_0Fragment { Frame _group_0_binding_0_fs; };

uniform highp sampler2D _group_0_binding_1_fs;

uniform highp sampler2D _group_0_binding_2_fs;

vec4 sky_peaks_found[4];

vec4 peaks_texel_1_phase[8];

vec4 peaks_texel_1_found[4];

float look_1_totals[8];

vec4 look_1_along[4];

float march_line_1_edges[64];

float march_line_1_distance_1_[24];

float march_line_1_radius[24];

float march_line_1_weight[24];

float march_line_1_density[192];

float march_line_1_columns[192];

float march_line_1_amounts[192];

float march_line_1_before[8];

float march_line_1_rho[8];

float march_line_1_depths[8];

float march_line_1_here[8];

float march_line_1_there[8];

float march_line_1_cuts[3];

float columns_along_1_distance_1_[24];

float columns_along_1_radius[24];

float columns_along_1_weight[24];

float columns_along_1_density[192];

layout(location = 0) out vec4 _fs2p_location0;
layout(location = 1) out vec4 _fs2p_location1;

int size_columns(int axis) {
    float _e8 = _group_0_binding_0_fs.table_columns[(min(axis, 2) + 1)];
    return ((axis == 3) ? 2 : int(_e8));
}

float read_columns(int index) {
    float _e4 = _group_0_binding_0_fs.table_columns.x;
    int at_6 = (index + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_6 & 2047), (at_6 >> 11u)), 0);
    return _e14.x;
}

int size_density(int axis_1) {
    float _e6 = _group_0_binding_0_fs.table_density[(axis_1 + 1)];
    return int(_e6);
}

float read_density(int index_1) {
    float _e4 = _group_0_binding_0_fs.table_density.x;
    int at_7 = (index_1 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_7 & 2047), (at_7 >> 11u)), 0);
    return _e14.x;
}

int size_strongest(int axis_2) {
    float _e6 = _group_0_binding_0_fs.table_strongest[(axis_2 + 1)];
    return int(_e6);
}

float read_strongest(int index_2) {
    float _e4 = _group_0_binding_0_fs.table_strongest.x;
    int at_8 = (index_2 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_8 & 2047), (at_8 >> 11u)), 0);
    return _e14.x;
}

int size_brightest(int axis_3) {
    float _e6 = _group_0_binding_0_fs.table_brightest[(axis_3 + 1)];
    return int(_e6);
}

float read_brightest(int index_3) {
    float _e4 = _group_0_binding_0_fs.table_brightest.x;
    int at_9 = (index_3 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_9 & 2047), (at_9 >> 11u)), 0);
    return _e14.x;
}

int size_lift(int axis_4) {
    float _e6 = _group_0_binding_0_fs.table_lift[(axis_4 + 1)];
    return int(_e6);
}

float read_lift(int index_4) {
    float _e4 = _group_0_binding_0_fs.table_lift.x;
    int at_10 = (index_4 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_10 & 2047), (at_10 >> 11u)), 0);
    return _e14.x;
}

int size_ends(int axis_5) {
    float _e6 = _group_0_binding_0_fs.table_ends[(axis_5 + 1)];
    return int(_e6);
}

float read_ends(int index_5) {
    float _e4 = _group_0_binding_0_fs.table_ends.x;
    int at_11 = (index_5 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_11 & 2047), (at_11 >> 11u)), 0);
    return _e14.x;
}

int size_row(int axis_6) {
    float _e6 = _group_0_binding_0_fs.table_row[(axis_6 + 1)];
    return int(_e6);
}

float read_row(int index_6) {
    float _e4 = _group_0_binding_0_fs.table_row.x;
    int at_12 = (index_6 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_12 & 2047), (at_12 >> 11u)), 0);
    return _e14.x;
}

int size_place(int axis_7) {
    float _e6 = _group_0_binding_0_fs.table_place[(axis_7 + 1)];
    return int(_e6);
}

float read_place(int index_7) {
    float _e4 = _group_0_binding_0_fs.table_place.x;
    int at_13 = (index_7 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_13 & 2047), (at_13 >> 11u)), 0);
    return _e14.x;
}

int size_start(int axis_8) {
    float _e6 = _group_0_binding_0_fs.table_start[(axis_8 + 1)];
    return int(_e6);
}

float read_start(int index_8) {
    float _e4 = _group_0_binding_0_fs.table_start.x;
    int at_14 = (index_8 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_14 & 2047), (at_14 >> 11u)), 0);
    return _e14.x;
}

int size_ahead(int axis_9) {
    float _e6 = _group_0_binding_0_fs.table_ahead[(axis_9 + 1)];
    return int(_e6);
}

float read_ahead(int index_9) {
    float _e4 = _group_0_binding_0_fs.table_ahead.x;
    int at_15 = (index_9 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_15 & 2047), (at_15 >> 11u)), 0);
    return _e14.x;
}

int size_back(int axis_10) {
    float _e6 = _group_0_binding_0_fs.table_back[(axis_10 + 1)];
    return int(_e6);
}

float read_back(int index_10) {
    float _e4 = _group_0_binding_0_fs.table_back.x;
    int at_16 = (index_10 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_16 & 2047), (at_16 >> 11u)), 0);
    return _e14.x;
}

int size_rules(int axis_11) {
    float _e6 = _group_0_binding_0_fs.table_rules[(axis_11 + 1)];
    return int(_e6);
}

float read_rules(int index_11) {
    float _e4 = _group_0_binding_0_fs.table_rules.x;
    int at_17 = (index_11 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_17 & 2047), (at_17 >> 11u)), 0);
    return _e14.x;
}

int size_extinction(int axis_12) {
    float _e6 = _group_0_binding_0_fs.table_extinction[(axis_12 + 1)];
    return int(_e6);
}

vec4 read_extinction(int index_12) {
    float _e4 = _group_0_binding_0_fs.table_extinction.x;
    int at_18 = (index_12 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_18 & 2047), (at_18 >> 11u)), 0);
    return _e14;
}

int size_scattering(int axis_13) {
    float _e6 = _group_0_binding_0_fs.table_scattering[(axis_13 + 1)];
    return int(_e6);
}

vec4 read_scattering(int index_13) {
    float _e4 = _group_0_binding_0_fs.table_scattering.x;
    int at_19 = (index_13 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_19 & 2047), (at_19 >> 11u)), 0);
    return _e14;
}

int size_moments(int axis_14) {
    float _e6 = _group_0_binding_0_fs.table_moments[(axis_14 + 1)];
    return int(_e6);
}

vec4 read_moments(int index_14) {
    float _e4 = _group_0_binding_0_fs.table_moments.x;
    int at_20 = (index_14 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_20 & 2047), (at_20 >> 11u)), 0);
    return _e14;
}

int size_albedo(int axis_15) {
    float _e6 = _group_0_binding_0_fs.table_albedo[(axis_15 + 1)];
    return int(_e6);
}

vec4 read_albedo(int index_15) {
    float _e4 = _group_0_binding_0_fs.table_albedo.x;
    int at_21 = (index_15 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_21 & 2047), (at_21 >> 11u)), 0);
    return _e14;
}

int size_phase(int axis_16) {
    float _e6 = _group_0_binding_0_fs.table_phase[(axis_16 + 1)];
    return int(_e6);
}

vec4 read_phase(int index_16) {
    float _e4 = _group_0_binding_0_fs.table_phase.x;
    int at_22 = (index_16 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_22 & 2047), (at_22 >> 11u)), 0);
    return _e14;
}

int size_basis(int axis_17) {
    float _e6 = _group_0_binding_0_fs.table_basis[(axis_17 + 1)];
    return int(_e6);
}

vec4 read_basis(int index_17) {
    float _e4 = _group_0_binding_0_fs.table_basis.x;
    int at_23 = (index_17 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_23 & 2047), (at_23 >> 11u)), 0);
    return _e14;
}

int size_field(int axis_18) {
    float _e6 = _group_0_binding_0_fs.table_field[(axis_18 + 1)];
    return int(_e6);
}

int size_sky(int axis_19) {
    float _e6 = _group_0_binding_0_fs.table_sky[(axis_19 + 1)];
    return int(_e6);
}

float squared(float x) {
    return (x * x);
}

float cubed(float x_1) {
    return ((x_1 * x_1) * x_1);
}

int whole_quotient(int a, int b) {
    bool local = false;
    int towards_zero = (a / b);
    if (((towards_zero * b) != a)) {
        local = ((a < 0) != (b < 0));
    } else {
        local = false;
    }
    bool _e15 = local;
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
    float value = (((quarter & 1) == 1) ? _e9 : _e8);
    return ((quarter >= 2) ? -(value) : value);
}

float cosine(float x_6) {
    bool local_1 = false;
    float turns_2 = roundEven((x_6 * 0.63661975));
    float _e4 = rest_of_quarter(x_6, turns_2);
    int quarter_1 = (int(turns_2) & 3);
    float _e8 = cosine_of_quarter(_e4);
    float _e9 = sine_of_quarter(_e4);
    float value_1 = (((quarter_1 & 1) == 1) ? _e9 : _e8);
    if (!((quarter_1 == 1))) {
        local_1 = (quarter_1 == 2);
    } else {
        local_1 = true;
    }
    bool _e24 = local_1;
    return (_e24 ? -(value_1) : value_1);
}

float angle_of(float y, float x_7) {
    float a_3 = abs(x_7);
    float b_3 = abs(y);
    float slope_3 = (min(a_3, b_3) / max(max(a_3, b_3), 1e-37));
    bool steep = (slope_3 > 0.41421357);
    float t_1 = (steep ? ((slope_3 - 1.0) / (slope_3 + 1.0)) : slope_3);
    float z_1 = (t_1 * t_1);
    float tail_1 = (-0.3333295 + (z_1 * (0.19977711 + (z_1 * (-0.13877685 + (z_1 * 0.080537446))))));
    float part_1 = ((steep ? 0.7853982 : 0.0) + (t_1 + ((t_1 * z_1) * tail_1)));
    float quarter_2 = ((b_3 > a_3) ? (1.5707964 - part_1) : part_1);
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

float row_coordinate(int row, int rows, bool outside) {
    float inside = 0.0;
    if ((row >= rows)) {
        return (float((row - rows)) / float((rows - 1)));
    }
    inside = (outside ? 0.1 : 0.0);
    float _e18 = inside;
    return (min(float(row), ((float(rows) - 1.0) - _e18)) / float((rows - 1)));
}

float impact_from_row(float row_1, bool sky, float bottom_radius, float top_radius) {
    if (sky) {
        return (bottom_radius + ((row_1 * row_1) * (top_radius - bottom_radius)));
    }
    return (bottom_radius * (1.0 - (row_1 * row_1)));
}

Several_f32_f32_ direction_from_row(float row_2, bool sky_1, float horizon_mu, float horizon_sine) {
    float highest = 0.0;
    float angle = 0.0;
    float turn = 0.0;
    float keep = 0.0;
    float _e8 = arc_cosine(horizon_mu);
    highest = _e8;
    float _e10 = highest;
    float _e13 = highest;
    angle = ((row_2 * row_2) * (sky_1 ? _e13 : (_e10 - 3.1415927)));
    float _e16 = angle;
    float _e17 = sine(_e16);
    float _e18 = angle;
    float _e19 = cosine(_e18);
    turn = _e17;
    keep = _e19;
    float _e20 = keep;
    float _e22 = turn;
    float _e25 = keep;
    float _e27 = turn;
    return Several_f32_f32_(((horizon_mu * _e20) + (horizon_sine * _e22)), ((horizon_sine * _e25) - (horizon_mu * _e27)));
}

float half_sine_between(float x_11, float y_1, float z, float sun_x, float sun_z) {
    float across = 0.0;
    across = (((x_11 - sun_x) * (x_11 - sun_x)) + (y_1 * y_1));
    float _e11 = across;
    return min((0.5 * sqrt((_e11 + ((z - sun_z) * (z - sun_z))))), 1.0);
}

Several_f32_f32_ first_meeting(float impact, float sine_1_, float radius) {
    float depth = 0.0;
    float down = 0.0;
    depth = sqrt(max(((radius - impact) * (radius + impact)), 0.0));
    down = sqrt(max(((1.0 - sine_1_) * (1.0 + sine_1_)), 0.0));
    float _e19 = down;
    float _e21 = depth;
    float _e25 = depth;
    float _e26 = down;
    return Several_f32_f32_(((impact * _e19) - (_e21 * sine_1_)), ((impact * sine_1_) + (_e25 * _e26)));
}

float star_from(float across_1, float up, float radius_1, float cos_azimuth, float sun_x_1, float sun_z_1) {
    return min(max(((((across_1 * cos_azimuth) * sun_x_1) + (up * sun_z_1)) / radius_1), -1.0), 1.0);
}

float chord(float r, float mu, float radius_2) {
    return sqrt(max((((radius_2 - r) * (radius_2 + r)) + (((r * r) * mu) * mu)), 0.0));
}

float distance_to_top(float r_1, float mu_1, float top_radius_1) {
    float _e5 = chord(r_1, mu_1, top_radius_1);
    return max(((-(r_1) * mu_1) + _e5), 0.0);
}

float distance_to_bottom(float r_2, float mu_2, float bottom_radius_1) {
    float _e5 = chord(r_2, mu_2, bottom_radius_1);
    return max(((-(r_2) * mu_2) - _e5), 0.0);
}

Several_f32_f32_ shadow_edges(float r_3, float mu_3, float mu_s, float nu, float bottom_radius_2) {
    float a_2 = 0.0;
    float b_2 = 0.0;
    float c = 0.0;
    float discriminant = 0.0;
    float root = 0.0;
    float first = 0.0;
    float second = 0.0;
    float plane = 0.0;
    a_2 = ((1.0 - nu) * (1.0 + nu));
    float _e18 = a_2;
    if ((_e18 < 1e-12)) {
        return Several_f32_f32_(0.0, 0.0);
    }
    b_2 = (r_3 * (mu_3 - (mu_s * nu)));
    c = ((((r_3 * r_3) * (1.0 - mu_s)) * (1.0 + mu_s)) - (bottom_radius_2 * bottom_radius_2));
    float _e36 = b_2;
    float _e37 = b_2;
    float _e39 = a_2;
    float _e40 = c;
    discriminant = ((_e36 * _e37) - (_e39 * _e40));
    float _e43 = discriminant;
    if ((_e43 <= 0.0)) {
        return Several_f32_f32_(0.0, 0.0);
    }
    float _e49 = discriminant;
    root = sqrt(_e49);
    float _e51 = b_2;
    float _e53 = root;
    float _e55 = a_2;
    first = ((-(_e51) - _e53) / _e55);
    float _e57 = b_2;
    float _e59 = root;
    float _e61 = a_2;
    second = ((-(_e57) + _e59) / _e61);
    if ((abs(nu) > 1e-12)) {
        plane = ((-(r_3) * mu_s) / nu);
        if ((nu > 0.0)) {
            float _e71 = second;
            float _e72 = plane;
            second = min(_e71, _e72);
        } else {
            float _e74 = first;
            float _e75 = plane;
            first = max(_e74, _e75);
        }
    } else {
        if ((mu_s >= 0.0)) {
            return Several_f32_f32_(0.0, 0.0);
        }
    }
    float _e82 = second;
    float _e83 = first;
    if ((_e82 <= _e83)) {
        return Several_f32_f32_(0.0, 0.0);
    }
    float _e88 = first;
    float _e89 = second;
    return Several_f32_f32_(_e88, _e89);
}

float radius_along(float r_4, float mu_4, float distance_1_) {
    return sqrt(max(((distance_1_ * (distance_1_ + ((2.0 * r_4) * mu_4))) + (r_4 * r_4)), 0.0));
}

Several_bool_f32_f32_f32_f32_ panel_leg(float r_5, float mu_5, float start, float end, float length_1_) {
    float nearest = 0.0;
    float tangent = 0.0;
    bool descending = false;
    float lowest = 0.0;
    float low = 0.0;
    float high = 0.0;
    float beside = 0.0;
    float u = 0.0;
    float first_1 = 0.0;
    float last = 0.0;
    nearest = (-(r_5) * mu_5);
    tangent = (r_5 * sqrt(max(((1.0 - mu_5) * (1.0 + mu_5)), 0.0)));
    float _e26 = nearest;
    descending = (end <= _e26);
    float _e28 = nearest;
    float _e31 = nearest;
    bool _e33 = descending;
    lowest = (_e33 ? min(_e31, length_1_) : max(_e28, 0.0));
    float _e35 = lowest;
    float _e36 = radius_along(r_5, mu_5, _e35);
    low = _e36;
    float _e37 = radius_along(r_5, mu_5, length_1_);
    bool _e38 = descending;
    high = (_e38 ? r_5 : _e37);
    float _e40 = lowest;
    float _e41 = nearest;
    beside = abs((_e40 - _e41));
    float _e44 = low;
    float _e45 = tangent;
    float _e47 = high;
    float _e48 = tangent;
    if (((_e44 - _e45) <= (0.02 * (_e47 - _e48)))) {
        float _e53 = tangent;
        float _e54 = low;
        low = min(_e53, _e54);
        beside = 0.0;
    }
    float _e57 = nearest;
    u = abs((start - _e57));
    float _e60 = u;
    float _e61 = beside;
    float _e63 = u;
    float _e64 = beside;
    float _e69 = radius_along(r_5, mu_5, start);
    float _e70 = low;
    first_1 = sqrt((max(((_e60 - _e61) * (_e63 + _e64)), 0.0) / (_e69 + _e70)));
    float _e74 = nearest;
    u = abs((end - _e74));
    float _e77 = u;
    float _e78 = beside;
    float _e80 = u;
    float _e81 = beside;
    float _e86 = radius_along(r_5, mu_5, end);
    float _e87 = low;
    last = sqrt((max(((_e77 - _e78) * (_e80 + _e81)), 0.0) / (_e86 + _e87)));
    bool _e91 = descending;
    float _e92 = low;
    float _e93 = beside;
    float _e94 = first_1;
    float _e95 = last;
    return Several_bool_f32_f32_f32_f32_(_e91, _e92, _e93, _e94, _e95);
}

Several_f32_f32_f32_ panel_point(float nearest_1, bool descending_1, float low_1, float beside_1, float first_2, float last_1, float node) {
    float y_2 = 0.0;
    float away = 0.0;
    float radius_3 = 0.0;
    float distance_1_1 = 0.0;
    float slope = 0.0;
    y_2 = (first_2 + ((last_1 - first_2) * node));
    float _e16 = y_2;
    float _e17 = y_2;
    float _e21 = y_2;
    float _e22 = y_2;
    away = sqrt(((beside_1 * beside_1) + ((_e16 * _e17) * ((2.0 * low_1) + (_e21 * _e22)))));
    float _e28 = y_2;
    float _e29 = y_2;
    radius_3 = (low_1 + (_e28 * _e29));
    float _e32 = away;
    float _e34 = away;
    distance_1_1 = (descending_1 ? (nearest_1 - _e34) : (nearest_1 + _e32));
    float _e39 = y_2;
    float _e42 = radius_3;
    float _e44 = away;
    float _e47 = away;
    slope = ((_e47 > 0.0) ? (abs((last_1 - first_2)) * (((2.0 * _e39) * _e42) / _e44)) : 0.0);
    float _e52 = distance_1_1;
    float _e53 = radius_3;
    float _e54 = slope;
    return Several_f32_f32_f32_(_e52, _e53, _e54);
}

Several_i32_f32_ density_place(float radius_4, float bottom_radius_3, float thickness, int nodes) {
    float altitude = 0.0;
    float x_12 = 0.0;
    int node_1 = 0;
    altitude = min(max(((radius_4 - bottom_radius_3) / thickness), 0.0), 1.0);
    float _e13 = altitude;
    x_12 = (sqrt(_e13) * float((nodes - 1)));
    float _e19 = x_12;
    node_1 = min(int(_e19), (nodes - 2));
    int _e24 = node_1;
    float _e25 = x_12;
    int _e26 = node_1;
    return Several_i32_f32_(_e24, (_e25 - float(_e26)));
}

float bend_angle(float x_13, float mu_6, float bend, float column) {
    return (((bend * column) * x_13) * sqrt(max(((1.0 - mu_6) * (1.0 + mu_6)), 0.0)));
}

Several_f32_f32_ turned(float mu_7, float mu_s_1, float nu_1, float angle_1) {
    float sine_1_1 = 0.0;
    float across_2 = 0.0;
    float turn_1 = 0.0;
    float keep_1 = 0.0;
    float here = 0.0;
    sine_1_1 = sqrt(max(((1.0 - mu_7) * (1.0 + mu_7)), 1e-18));
    float _e19 = sine_1_1;
    across_2 = ((nu_1 - (mu_7 * mu_s_1)) / _e19);
    float _e21 = sine(angle_1);
    float _e22 = cosine(angle_1);
    turn_1 = _e21;
    keep_1 = _e22;
    float _e23 = keep_1;
    float _e25 = turn_1;
    float _e26 = across_2;
    here = ((_e23 * mu_s_1) + (_e25 * _e26));
    float _e29 = here;
    float _e30 = here;
    float _e32 = sine_1_1;
    float _e33 = keep_1;
    float _e34 = across_2;
    float _e36 = turn_1;
    return Several_f32_f32_(_e29, ((mu_7 * _e30) + (_e32 * ((_e33 * _e34) - (_e36 * mu_s_1)))));
}

float horizon_cosine(float r_6, float bottom_radius_4) {
    return (-(sqrt(max(((r_6 - bottom_radius_4) * (r_6 + bottom_radius_4)), 0.0))) / r_6);
}

float sun_elevation(float r_7, float mu_s_2, float bottom_radius_5) {
    float sine_1_2 = 0.0;
    sine_1_2 = (bottom_radius_5 / r_7);
    float _e5 = horizon_cosine(r_7, bottom_radius_5);
    float _e7 = sine_1_2;
    return ((mu_s_2 - _e5) / _e7);
}

Several_f32_f32_f32_ seen_star(float x_14, float mu_s_3, float bottom, float top) {
    float sine_1_3 = 0.0;
    float horizon = 0.0;
    float tangent_1 = 0.0;
    float at_1 = 0.0;
    int row_3 = 0;
    float f = 0.0;
    float true_horizon = 0.0;
    float above = 0.0;
    float share = 0.0;
    int column_1 = 0;
    float e = 0.0;
    float w00_ = 0.0;
    float w01_ = 0.0;
    float w10_ = 0.0;
    float w11_ = 0.0;
    float raised = 0.0;
    float squeeze = 0.0;
    int _e22 = size_lift(0);
    if ((_e22 == 0)) {
        float _e25 = sun_elevation(x_14, mu_s_3, bottom);
        return Several_f32_f32_f32_(mu_s_3, 1.0, _e25);
    }
    sine_1_3 = (bottom / x_14);
    float _e29 = horizon_cosine(x_14, bottom);
    horizon = _e29;
    tangent_1 = sqrt(((top - bottom) * (top + bottom)));
    float _e40 = tangent_1;
    int _e43 = size_lift(0);
    at_1 = ((sqrt(max(((x_14 - bottom) * (x_14 + bottom)), 0.0)) / _e40) * float((_e43 - 1)));
    float _e48 = at_1;
    int _e51 = size_lift(0);
    row_3 = min(int(_e48), (_e51 - 2));
    float _e55 = at_1;
    int _e56 = row_3;
    f = (_e55 - float(_e56));
    float _e59 = horizon;
    int _e60 = row_3;
    int _e62 = size_lift(1);
    int _e67 = size_lift(2);
    float _e71 = read_lift(((((_e60 * _e62) + 0) * _e67) + 0));
    float _e72 = f;
    int _e76 = row_3;
    int _e80 = size_lift(1);
    int _e85 = size_lift(2);
    float _e89 = read_lift((((((_e76 + 1) * _e80) + 0) * _e85) + 0));
    float _e90 = f;
    true_horizon = (_e59 - ((_e71 * (1.0 - _e72)) + (_e89 * _e90)));
    float _e94 = true_horizon;
    above = (mu_s_3 - _e94);
    float _e96 = above;
    float _e99 = true_horizon;
    int _e107 = size_lift(1);
    share = (sqrt(min((max(_e96, 0.0) / (1.0 - _e99)), 1.0)) * float((_e107 - 1)));
    float _e112 = share;
    int _e115 = size_lift(1);
    column_1 = min(int(_e112), (_e115 - 2));
    float _e119 = share;
    int _e120 = column_1;
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
    int _e144 = row_3;
    int _e146 = size_lift(1);
    int _e148 = column_1;
    int _e151 = size_lift(2);
    float _e155 = read_lift(((((_e144 * _e146) + _e148) * _e151) + 0));
    float _e157 = w01_;
    int _e158 = row_3;
    int _e160 = size_lift(1);
    int _e162 = column_1;
    int _e167 = size_lift(2);
    float _e171 = read_lift(((((_e158 * _e160) + (_e162 + 1)) * _e167) + 0));
    float _e174 = w10_;
    int _e175 = row_3;
    int _e179 = size_lift(1);
    int _e181 = column_1;
    int _e184 = size_lift(2);
    float _e188 = read_lift((((((_e175 + 1) * _e179) + _e181) * _e184) + 0));
    float _e191 = w11_;
    int _e192 = row_3;
    int _e196 = size_lift(1);
    int _e198 = column_1;
    int _e203 = size_lift(2);
    float _e207 = read_lift((((((_e192 + 1) * _e196) + (_e198 + 1)) * _e203) + 0));
    raised = ((((_e143 * _e155) + (_e157 * _e171)) + (_e174 * _e188)) + (_e191 * _e207));
    float _e210 = w00_;
    int _e211 = row_3;
    int _e213 = size_lift(1);
    int _e215 = column_1;
    int _e218 = size_lift(2);
    float _e222 = read_lift(((((_e211 * _e213) + _e215) * _e218) + 1));
    float _e224 = w01_;
    int _e225 = row_3;
    int _e227 = size_lift(1);
    int _e229 = column_1;
    int _e234 = size_lift(2);
    float _e238 = read_lift(((((_e225 * _e227) + (_e229 + 1)) * _e234) + 1));
    float _e241 = w10_;
    int _e242 = row_3;
    int _e246 = size_lift(1);
    int _e248 = column_1;
    int _e251 = size_lift(2);
    float _e255 = read_lift((((((_e242 + 1) * _e246) + _e248) * _e251) + 1));
    float _e258 = w11_;
    int _e259 = row_3;
    int _e263 = size_lift(1);
    int _e265 = column_1;
    int _e270 = size_lift(2);
    float _e274 = read_lift((((((_e259 + 1) * _e263) + (_e265 + 1)) * _e270) + 1));
    squeeze = ((((_e210 * _e222) + (_e224 * _e238)) + (_e241 * _e255)) + (_e258 * _e274));
    float _e277 = raised;
    float _e281 = squeeze;
    float _e282 = above;
    float _e283 = sine_1_3;
    return Several_f32_f32_f32_(min((mu_s_3 + _e277), 1.0), _e281, (_e282 / _e283));
}

float visible_fraction(float elevation, float angular_radius) {
    float x_15 = 0.0;
    if ((angular_radius <= 0.0)) {
        return ((elevation > 0.0) ? 1.0 : 0.0);
    }
    x_15 = (elevation / angular_radius);
    float _e11 = x_15;
    if ((_e11 >= 1.0)) {
        return 1.0;
    }
    float _e15 = x_15;
    if ((_e15 <= -1.0)) {
        return 0.0;
    }
    float _e19 = x_15;
    float _e21 = arc_cosine(-(_e19));
    float _e22 = x_15;
    float _e23 = x_15;
    float _e24 = x_15;
    return ((_e21 + (_e22 * sqrt((1.0 - (_e23 * _e24))))) / 3.1415927);
}

Several_f32_f32_ visible_spread(float elevation_1, float angular_radius_1) {
    float x_16 = 0.0;
    float rest = 0.0;
    float area = 0.0;
    float mean = 0.0;
    float square = 0.0;
    float deviation = 0.0;
    x_16 = (elevation_1 / angular_radius_1);
    float _e9 = x_16;
    if ((_e9 >= 1.0)) {
        return Several_f32_f32_(elevation_1, (0.5 * angular_radius_1));
    }
    float _e15 = x_16;
    float _e18 = x_16;
    rest = sqrt(max(((1.0 - _e15) * (1.0 + _e18)), 0.0));
    float _e25 = x_16;
    float _e27 = arc_cosine(-(_e25));
    float _e28 = x_16;
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
    float _e49 = x_16;
    float _e50 = arc_sine(_e49);
    float _e53 = x_16;
    float _e54 = rest;
    float _e56 = x_16;
    float _e59 = x_16;
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

Several_f32_f32_f32_ star_points(float x_17, float mu_s_4, float bottom_1, float top_1, float star_radius) {
    float seen = 0.0;
    float squeeze_1 = 0.0;
    float elevation_2 = 0.0;
    float received = 0.0;
    float mean_1 = 0.0;
    float deviation_1 = 0.0;
    float middle = 0.0;
    float apart = 0.0;
    float lowest_1 = 0.0;
    bool local_2 = false;
    bool local_3 = false;
    Several_f32_f32_f32_ _e14 = seen_star(x_17, mu_s_4, bottom_1, top_1);
    seen = _e14.v0_;
    squeeze_1 = _e14.v1_;
    elevation_2 = _e14.v2_;
    float _e18 = squeeze_1;
    float _e19 = elevation_2;
    float _e20 = visible_fraction(_e19, star_radius);
    received = (_e18 * _e20);
    float _e22 = received;
    if (!((_e22 <= 0.0))) {
        local_2 = (star_radius <= 0.0);
    } else {
        local_2 = true;
    }
    bool _e31 = local_2;
    if (!(_e31)) {
        float _e35 = elevation_2;
        local_3 = (_e35 > (16.0 * star_radius));
    } else {
        local_3 = true;
    }
    bool _e40 = local_3;
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
    middle = (_e49 + ((_e50 * (bottom_1 / x_17)) * (_e53 - _e54)));
    float _e58 = squeeze_1;
    float _e61 = deviation_1;
    apart = ((_e58 * (bottom_1 / x_17)) * _e61);
    float _e63 = horizon_cosine(x_17, bottom_1);
    lowest_1 = _e63;
    float _e64 = received;
    float _e65 = middle;
    float _e66 = apart;
    float _e68 = lowest_1;
    float _e70 = middle;
    float _e71 = apart;
    return Several_f32_f32_f32_(_e64, max((_e65 - _e66), _e68), min((_e70 + _e71), 1.0));
}

float altitude_coordinate(float r_8, float bottom_radius_6, float top_radius_2) {
    float tangent_2 = 0.0;
    tangent_2 = sqrt(((top_radius_2 - bottom_radius_6) * (top_radius_2 + bottom_radius_6)));
    float _e14 = tangent_2;
    return (sqrt(max(((r_8 - bottom_radius_6) * (r_8 + bottom_radius_6)), 0.0)) / _e14);
}

float direction_coordinate(float r_9, float mu_8, float bottom_radius_7, float top_radius_3) {
    float shortest = 0.0;
    float longest = 0.0;
    float distance_1_2 = 0.0;
    shortest = (top_radius_3 - r_9);
    longest = (sqrt(max(((r_9 - bottom_radius_7) * (r_9 + bottom_radius_7)), 0.0)) + sqrt(((top_radius_3 - bottom_radius_7) * (top_radius_3 + bottom_radius_7))));
    float _e19 = distance_to_top(r_9, mu_8, top_radius_3);
    distance_1_2 = _e19;
    float _e20 = distance_1_2;
    float _e21 = shortest;
    float _e23 = longest;
    float _e24 = shortest;
    return min(max(((_e20 - _e21) / (_e23 - _e24)), 0.0), 1.0);
}

void read_phase_here_1_(float half_sine, int nodes_1, int width) {
    float u_1 = 0.0;
    int node_2 = 0;
    float f_1 = 0.0;
    int at_2 = 0;
    vec4 low_2 = vec4(0.0);
    vec4 high_1 = vec4(0.0);
    u_1 = (half_sine * float((nodes_1 - 1)));
    float _e13 = u_1;
    node_2 = min(int(_e13), (nodes_1 - 2));
    float _e18 = u_1;
    int _e19 = node_2;
    f_1 = (_e18 - float(_e19));
    at_2 = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e47 = at_2;
            at_2 = (_e47 + 1);
        }
        loop_init = false;
        int _e23 = at_2;
        if ((_e23 < width)) {
        } else {
            break;
        }
        {
            int _e25 = node_2;
            int _e27 = at_2;
            vec4 _e29 = read_phase(((_e25 * width) + _e27));
            low_2 = _e29;
            int _e30 = node_2;
            int _e34 = at_2;
            vec4 _e36 = read_phase((((_e30 + 1) * width) + _e34));
            high_1 = _e36;
            int _e38 = at_2;
            vec4 _e40 = low_2;
            float _e41 = f_1;
            vec4 _e42 = high_1;
            vec4 _e43 = low_2;
            peaks_texel_1_phase[_e38] = (_e40 + (_e41 * (_e42 - _e43)));
        }
    }
    return;
}

void phases_towards_1_(float half_sine_1) {
    float _e4 = _group_0_binding_0_fs.peaks.x;
    float _e9 = _group_0_binding_0_fs.counts.x;
    read_phase_here_1_(half_sine_1, int(_e4), (1 * int(_e9)));
    float _e16 = _group_0_binding_0_fs.peaks.y;
    if ((int(_e16) >= 0)) {
        float _e24 = _group_0_binding_0_fs.peaks.y;
        peaks_texel_1_phase[(1 * int(_e24))] = vec4(0.0);
    }
    float _e34 = _group_0_binding_0_fs.peaks.z;
    if ((int(_e34) >= 0)) {
        float _e42 = _group_0_binding_0_fs.peaks.z;
        peaks_texel_1_phase[(1 * int(_e42))] = vec4(0.0);
        return;
    } else {
        return;
    }
}

int insert_edge_1_(int count, float cut) {
    int place = 0;
    bool local_4 = false;
    bool local_5 = false;
    if ((0.0 < cut)) {
        float _e11 = march_line_1_edges[(count - 1)];
        local_4 = (cut < _e11);
    } else {
        local_4 = false;
    }
    bool _e14 = local_4;
    if (!(!(_e14))) {
        local_5 = (count >= 64);
    } else {
        local_5 = true;
    }
    bool _e22 = local_5;
    if (_e22) {
        return count;
    }
    place = count;
    while(true) {
        int _e24 = place;
        float _e28 = march_line_1_edges[(_e24 - 1)];
        if ((_e28 > cut)) {
        } else {
            break;
        }
        {
            int _e31 = place;
            int _e34 = place;
            float _e38 = march_line_1_edges[(_e34 - 1)];
            march_line_1_edges[_e31] = _e38;
            int _e39 = place;
            place = (_e39 - 1);
        }
    }
    int _e43 = place;
    march_line_1_edges[_e43] = cut;
    return (count + 1);
}

int place_edges_1_(float r_10, float mu_9, float length_1_1, float first_cut, float second_cut) {
    float nearest_2 = 0.0;
    int count_1 = 0;
    float start_1 = 0.0;
    int leg = 0;
    float end_1 = 0.0;
    int part = 0;
    float x_18 = 0.0;
    float low_3 = 0.0;
    float high_2 = 0.0;
    float radius_5 = 0.0;
    float at_3 = 0.0;
    nearest_2 = (-(r_10) * mu_9);
    march_line_1_edges[0] = 0.0;
    count_1 = 1;
    start_1 = 0.0;
    leg = 0;
    bool loop_init_1 = true;
    while(true) {
        if (!loop_init_1) {
            int _e111 = leg;
            leg = (_e111 + 1);
        }
        loop_init_1 = false;
        int _e24 = leg;
        if ((_e24 < 2)) {
        } else {
            break;
        }
        {
            float _e27 = nearest_2;
            int _e29 = leg;
            end_1 = ((_e29 == 0) ? min(_e27, length_1_1) : length_1_1);
            float _e33 = end_1;
            float _e34 = start_1;
            if ((_e33 <= _e34)) {
                continue;
            }
            part = 1;
            bool loop_init_2 = true;
            while(true) {
                if (!loop_init_2) {
                    int _e101 = part;
                    part = (_e101 + 1);
                }
                loop_init_2 = false;
                int _e37 = part;
                if ((_e37 < 2)) {
                } else {
                    break;
                }
                {
                    int _e40 = part;
                    x_18 = (float(_e40) / 1.0);
                    int _e44 = leg;
                    if ((_e44 == 0)) {
                        float _e47 = end_1;
                        float _e48 = radius_along(r_10, mu_9, _e47);
                        low_3 = _e48;
                        float _e49 = start_1;
                        float _e50 = radius_along(r_10, mu_9, _e49);
                        high_2 = _e50;
                        float _e51 = low_3;
                        float _e52 = high_2;
                        float _e53 = low_3;
                        float _e55 = x_18;
                        float _e59 = x_18;
                        radius_5 = (_e51 + (((_e52 - _e53) * (1.0 - _e55)) * (1.0 - _e59)));
                        float _e64 = nearest_2;
                        float _e65 = radius_5;
                        float _e66 = chord(r_10, mu_9, _e65);
                        at_3 = (_e64 - _e66);
                    } else {
                        float _e68 = start_1;
                        float _e69 = radius_along(r_10, mu_9, _e68);
                        low_3 = _e69;
                        float _e70 = end_1;
                        float _e71 = radius_along(r_10, mu_9, _e70);
                        high_2 = _e71;
                        float _e72 = low_3;
                        float _e73 = high_2;
                        float _e74 = low_3;
                        float _e76 = x_18;
                        float _e78 = x_18;
                        radius_5 = (_e72 + (((_e73 - _e74) * _e76) * _e78));
                        float _e81 = nearest_2;
                        float _e82 = radius_5;
                        float _e83 = chord(r_10, mu_9, _e82);
                        at_3 = (_e81 + _e83);
                    }
                    int _e86 = count_1;
                    float _e88 = at_3;
                    int _e90 = count_1;
                    float _e94 = march_line_1_edges[(_e90 - 1)];
                    float _e96 = end_1;
                    march_line_1_edges[_e86] = min(max(_e88, _e94), _e96);
                    int _e98 = count_1;
                    count_1 = (_e98 + 1);
                }
            }
            int _e105 = count_1;
            float _e109 = end_1;
            march_line_1_edges[(_e105 - 1)] = _e109;
            float _e110 = end_1;
            start_1 = _e110;
        }
    }
    int _e114 = count_1;
    int _e115 = insert_edge_1_(_e114, first_cut);
    count_1 = _e115;
    int _e116 = count_1;
    int _e117 = insert_edge_1_(_e116, second_cut);
    return _e117;
}

int cut_at_corners_1_(float r_11, float mu_10, float bottom_radius_8, int count_given) {
    int count_2 = 0;
    float tangent_3 = 0.0;
    int k = 0;
    float radius_6 = 0.0;
    float beside_2 = 0.0;
    count_2 = count_given;
    tangent_3 = (r_11 * sqrt(max(((1.0 - mu_10) * (1.0 + mu_10)), 0.0)));
    k = 0;
    bool loop_init_3 = true;
    while(true) {
        if (!loop_init_3) {
            int _e43 = k;
            k = (_e43 + 1);
        }
        loop_init_3 = false;
        int _e19 = k;
        int _e21 = size_ends(0);
        if ((_e19 < _e21)) {
        } else {
            break;
        }
        {
            int _e23 = k;
            float _e24 = read_ends(_e23);
            radius_6 = (bottom_radius_8 + _e24);
            float _e26 = tangent_3;
            float _e27 = radius_6;
            if ((_e26 < _e27)) {
                float _e29 = radius_6;
                float _e30 = chord(r_11, mu_10, _e29);
                beside_2 = _e30;
                int _e31 = count_2;
                float _e34 = beside_2;
                int _e36 = insert_edge_1_(_e31, ((-(r_11) * mu_10) - _e34));
                count_2 = _e36;
                int _e37 = count_2;
                float _e40 = beside_2;
                int _e42 = insert_edge_1_(_e37, ((-(r_11) * mu_10) + _e40));
                count_2 = _e42;
            }
        }
    }
    int _e46 = count_2;
    return _e46;
}

void place_panel_2_(float r_12, float mu_11, float start_2, float end_2, float length_1_2, int rule) {
    int n = 0;
    bool descending_2 = false;
    float low_4 = 0.0;
    float beside_3 = 0.0;
    float first_3 = 0.0;
    float last_2 = 0.0;
    int k_1 = 0;
    float slope_1 = 0.0;
    int node_3 = 0;
    float share_1 = 0.0;
    int c_1 = 0;
    float here_1 = 0.0;
    float _e18 = read_rules(rule);
    n = int(_e18);
    Several_bool_f32_f32_f32_f32_ _e20 = panel_leg(r_12, mu_11, start_2, end_2, length_1_2);
    descending_2 = _e20.v0_;
    low_4 = _e20.v1_;
    beside_3 = _e20.v2_;
    first_3 = _e20.v3_;
    last_2 = _e20.v4_;
    k_1 = 0;
    bool loop_init_4 = true;
    while(true) {
        if (!loop_init_4) {
            int _e258 = k_1;
            k_1 = (_e258 + 1);
        }
        loop_init_4 = false;
        int _e27 = k_1;
        int _e28 = n;
        if ((_e27 < _e28)) {
        } else {
            break;
        }
        {
            bool _e32 = descending_2;
            float _e33 = low_4;
            float _e34 = beside_3;
            float _e35 = first_3;
            float _e36 = last_2;
            int _e39 = k_1;
            float _e41 = read_rules(((rule + 1) + _e39));
            Several_f32_f32_f32_ _e42 = panel_point((-(r_12) * mu_11), _e32, _e33, _e34, _e35, _e36, _e41);
            int _e44 = k_1;
            columns_along_1_distance_1_[_e44] = _e42.v0_;
            int _e48 = k_1;
            columns_along_1_radius[_e48] = _e42.v1_;
            slope_1 = _e42.v2_;
            int _e53 = k_1;
            float _e55 = slope_1;
            int _e58 = n;
            int _e60 = k_1;
            float _e62 = read_rules((((rule + 1) + _e58) + _e60));
            columns_along_1_weight[_e53] = (_e55 * _e62);
            int _e65 = k_1;
            float _e67 = columns_along_1_radius[_e65];
            float _e71 = _group_0_binding_0_fs.shell.x;
            float _e75 = _group_0_binding_0_fs.shell.y;
            float _e79 = _group_0_binding_0_fs.shell.x;
            int _e82 = size_density(0);
            Several_i32_f32_ _e83 = density_place(_e67, _e71, (_e75 - _e79), _e82);
            node_3 = _e83.v0_;
            share_1 = _e83.v1_;
            float _e89 = _group_0_binding_0_fs.counts.x;
            int end_4_ = int(_e89);
            c_1 = 0;
            bool loop_init_5 = true;
            while(true) {
                if (!loop_init_5) {
                    int _e221 = c_1;
                    c_1 = (_e221 + 1);
                }
                loop_init_5 = false;
                int _e92 = c_1;
                if (((_e92 + 3) < end_4_)) {
                } else {
                    break;
                }
                {
                    int _e96 = node_3;
                    int _e98 = size_density(1);
                    int _e100 = c_1;
                    float _e102 = read_density(((_e96 * _e98) + _e100));
                    here_1 = _e102;
                    int _e104 = c_1;
                    int _e107 = k_1;
                    float _e110 = here_1;
                    int _e111 = node_3;
                    int _e115 = size_density(1);
                    int _e117 = c_1;
                    float _e119 = read_density((((_e111 + 1) * _e115) + _e117));
                    float _e120 = here_1;
                    float _e122 = share_1;
                    columns_along_1_density[((_e104 * 24) + _e107)] = (_e110 + ((_e119 - _e120) * _e122));
                    int _e125 = c_1;
                    c_1 = (_e125 + 1);
                    int _e128 = node_3;
                    int _e130 = size_density(1);
                    int _e132 = c_1;
                    float _e134 = read_density(((_e128 * _e130) + _e132));
                    here_1 = _e134;
                    int _e136 = c_1;
                    int _e139 = k_1;
                    float _e142 = here_1;
                    int _e143 = node_3;
                    int _e147 = size_density(1);
                    int _e149 = c_1;
                    float _e151 = read_density((((_e143 + 1) * _e147) + _e149));
                    float _e152 = here_1;
                    float _e154 = share_1;
                    columns_along_1_density[((_e136 * 24) + _e139)] = (_e142 + ((_e151 - _e152) * _e154));
                    int _e157 = c_1;
                    c_1 = (_e157 + 1);
                    int _e160 = node_3;
                    int _e162 = size_density(1);
                    int _e164 = c_1;
                    float _e166 = read_density(((_e160 * _e162) + _e164));
                    here_1 = _e166;
                    int _e168 = c_1;
                    int _e171 = k_1;
                    float _e174 = here_1;
                    int _e175 = node_3;
                    int _e179 = size_density(1);
                    int _e181 = c_1;
                    float _e183 = read_density((((_e175 + 1) * _e179) + _e181));
                    float _e184 = here_1;
                    float _e186 = share_1;
                    columns_along_1_density[((_e168 * 24) + _e171)] = (_e174 + ((_e183 - _e184) * _e186));
                    int _e189 = c_1;
                    c_1 = (_e189 + 1);
                    int _e192 = node_3;
                    int _e194 = size_density(1);
                    int _e196 = c_1;
                    float _e198 = read_density(((_e192 * _e194) + _e196));
                    here_1 = _e198;
                    int _e200 = c_1;
                    int _e203 = k_1;
                    float _e206 = here_1;
                    int _e207 = node_3;
                    int _e211 = size_density(1);
                    int _e213 = c_1;
                    float _e215 = read_density((((_e207 + 1) * _e211) + _e213));
                    float _e216 = here_1;
                    float _e218 = share_1;
                    columns_along_1_density[((_e200 * 24) + _e203)] = (_e206 + ((_e215 - _e216) * _e218));
                }
            }
            bool loop_init_6 = true;
            while(true) {
                if (!loop_init_6) {
                    int _e255 = c_1;
                    c_1 = (_e255 + 1);
                }
                loop_init_6 = false;
                int _e224 = c_1;
                if ((_e224 < end_4_)) {
                } else {
                    break;
                }
                {
                    int _e226 = node_3;
                    int _e228 = size_density(1);
                    int _e230 = c_1;
                    float _e232 = read_density(((_e226 * _e228) + _e230));
                    here_1 = _e232;
                    int _e234 = c_1;
                    int _e237 = k_1;
                    float _e240 = here_1;
                    int _e241 = node_3;
                    int _e245 = size_density(1);
                    int _e247 = c_1;
                    float _e249 = read_density((((_e241 + 1) * _e245) + _e247));
                    float _e250 = here_1;
                    float _e252 = share_1;
                    columns_along_1_density[((_e234 * 24) + _e237)] = (_e240 + ((_e249 - _e250) * _e252));
                }
            }
        }
    }
    return;
}

float columns_along_1_(float r_13, float mu_12, int count_3, int rule_1) {
    int n_1 = 0;
    int c_2 = 0;
    float reached = 0.0;
    float at_4 = 0.0;
    int panel = 0;
    int k_2 = 0;
    float depth_1 = 0.0;
    float amount = 0.0;
    int which = 0;
    float wanted = 0.0;
    bool local_6 = false;
    bool local_7 = false;
    bool local_8 = false;
    bool local_9 = false;
    bool local_10 = false;
    float _e14 = read_rules(rule_1);
    n_1 = int(_e14);
    float _e19 = _group_0_binding_0_fs.counts.x;
    int end_1_ = int(_e19);
    c_2 = 0;
    bool loop_init_7 = true;
    while(true) {
        if (!loop_init_7) {
            int _e51 = c_2;
            c_2 = (_e51 + 1);
        }
        loop_init_7 = false;
        int _e22 = c_2;
        if (((_e22 + 3) < end_1_)) {
        } else {
            break;
        }
        {
            int _e27 = c_2;
            look_1_totals[_e27] = 0.0;
            int _e30 = c_2;
            c_2 = (_e30 + 1);
            int _e34 = c_2;
            look_1_totals[_e34] = 0.0;
            int _e37 = c_2;
            c_2 = (_e37 + 1);
            int _e41 = c_2;
            look_1_totals[_e41] = 0.0;
            int _e44 = c_2;
            c_2 = (_e44 + 1);
            int _e48 = c_2;
            look_1_totals[_e48] = 0.0;
        }
    }
    bool loop_init_8 = true;
    while(true) {
        if (!loop_init_8) {
            int _e60 = c_2;
            c_2 = (_e60 + 1);
        }
        loop_init_8 = false;
        int _e54 = c_2;
        if ((_e54 < end_1_)) {
        } else {
            break;
        }
        {
            int _e57 = c_2;
            look_1_totals[_e57] = 0.0;
        }
    }
    march_line_1_cuts[0] = 0.0;
    march_line_1_cuts[1] = 0.0;
    march_line_1_cuts[2] = 0.0;
    reached = 0.0;
    at_4 = 0.0;
    panel = 0;
    bool loop_init_9 = true;
    while(true) {
        if (!loop_init_9) {
            int _e500 = panel;
            panel = (_e500 + 1);
        }
        loop_init_9 = false;
        int _e75 = panel;
        if ((_e75 < (count_3 - 1))) {
        } else {
            break;
        }
        {
            int _e80 = panel;
            float _e82 = march_line_1_edges[_e80];
            int _e84 = panel;
            float _e88 = march_line_1_edges[(_e84 + 1)];
            float _e93 = march_line_1_edges[(count_3 - 1)];
            place_panel_2_(r_13, mu_12, _e82, _e88, _e93, rule_1);
            k_2 = 0;
            bool loop_init_10 = true;
            while(true) {
                if (!loop_init_10) {
                    int _e497 = k_2;
                    k_2 = (_e497 + 1);
                }
                loop_init_10 = false;
                int _e95 = k_2;
                int _e96 = n_1;
                if ((_e95 < _e96)) {
                } else {
                    break;
                }
                {
                    float _e98 = reached;
                    depth_1 = _e98;
                    float _e102 = _group_0_binding_0_fs.counts.x;
                    int end_4_1 = int(_e102);
                    c_2 = 0;
                    bool loop_init_11 = true;
                    while(true) {
                        if (!loop_init_11) {
                            int _e230 = c_2;
                            c_2 = (_e230 + 1);
                        }
                        loop_init_11 = false;
                        int _e105 = c_2;
                        if (((_e105 + 3) < end_4_1)) {
                        } else {
                            break;
                        }
                        {
                            int _e110 = c_2;
                            int _e113 = k_2;
                            float _e116 = columns_along_1_density[((_e110 * 24) + _e113)];
                            int _e118 = k_2;
                            float _e120 = columns_along_1_weight[_e118];
                            amount = (_e116 * _e120);
                            int _e123 = c_2;
                            int _e126 = c_2;
                            float _e128 = look_1_totals[_e126];
                            float _e129 = amount;
                            look_1_totals[_e123] = (_e128 + _e129);
                            float _e131 = depth_1;
                            int _e132 = c_2;
                            float _e133 = read_strongest(_e132);
                            float _e134 = amount;
                            depth_1 = (_e131 + (_e133 * _e134));
                            int _e137 = c_2;
                            c_2 = (_e137 + 1);
                            int _e141 = c_2;
                            int _e144 = k_2;
                            float _e147 = columns_along_1_density[((_e141 * 24) + _e144)];
                            int _e149 = k_2;
                            float _e151 = columns_along_1_weight[_e149];
                            amount = (_e147 * _e151);
                            int _e154 = c_2;
                            int _e157 = c_2;
                            float _e159 = look_1_totals[_e157];
                            float _e160 = amount;
                            look_1_totals[_e154] = (_e159 + _e160);
                            float _e162 = depth_1;
                            int _e163 = c_2;
                            float _e164 = read_strongest(_e163);
                            float _e165 = amount;
                            depth_1 = (_e162 + (_e164 * _e165));
                            int _e168 = c_2;
                            c_2 = (_e168 + 1);
                            int _e172 = c_2;
                            int _e175 = k_2;
                            float _e178 = columns_along_1_density[((_e172 * 24) + _e175)];
                            int _e180 = k_2;
                            float _e182 = columns_along_1_weight[_e180];
                            amount = (_e178 * _e182);
                            int _e185 = c_2;
                            int _e188 = c_2;
                            float _e190 = look_1_totals[_e188];
                            float _e191 = amount;
                            look_1_totals[_e185] = (_e190 + _e191);
                            float _e193 = depth_1;
                            int _e194 = c_2;
                            float _e195 = read_strongest(_e194);
                            float _e196 = amount;
                            depth_1 = (_e193 + (_e195 * _e196));
                            int _e199 = c_2;
                            c_2 = (_e199 + 1);
                            int _e203 = c_2;
                            int _e206 = k_2;
                            float _e209 = columns_along_1_density[((_e203 * 24) + _e206)];
                            int _e211 = k_2;
                            float _e213 = columns_along_1_weight[_e211];
                            amount = (_e209 * _e213);
                            int _e216 = c_2;
                            int _e219 = c_2;
                            float _e221 = look_1_totals[_e219];
                            float _e222 = amount;
                            look_1_totals[_e216] = (_e221 + _e222);
                            float _e224 = depth_1;
                            int _e225 = c_2;
                            float _e226 = read_strongest(_e225);
                            float _e227 = amount;
                            depth_1 = (_e224 + (_e226 * _e227));
                        }
                    }
                    bool loop_init_12 = true;
                    while(true) {
                        if (!loop_init_12) {
                            int _e263 = c_2;
                            c_2 = (_e263 + 1);
                        }
                        loop_init_12 = false;
                        int _e233 = c_2;
                        if ((_e233 < end_4_1)) {
                        } else {
                            break;
                        }
                        {
                            int _e236 = c_2;
                            int _e239 = k_2;
                            float _e242 = columns_along_1_density[((_e236 * 24) + _e239)];
                            int _e244 = k_2;
                            float _e246 = columns_along_1_weight[_e244];
                            amount = (_e242 * _e246);
                            int _e249 = c_2;
                            int _e252 = c_2;
                            float _e254 = look_1_totals[_e252];
                            float _e255 = amount;
                            look_1_totals[_e249] = (_e254 + _e255);
                            float _e257 = depth_1;
                            int _e258 = c_2;
                            float _e259 = read_strongest(_e258);
                            float _e260 = amount;
                            depth_1 = (_e257 + (_e259 * _e260));
                        }
                    }
                    float _e266 = depth_1;
                    float _e267 = reached;
                    if ((_e266 > _e267)) {
                        which = 0;
                        bool loop_init_13 = true;
                        while(true) {
                            if (!loop_init_13) {
                                int _e444 = which;
                                which = (_e444 + 1);
                            }
                            loop_init_13 = false;
                            int _e271 = which;
                            if (((_e271 + 3) < 3)) {
                            } else {
                                break;
                            }
                            {
                                int _e275 = which;
                                int _e281 = which;
                                wanted = ((_e281 == 0) ? 0.5 : ((_e275 == 1) ? 3.0 : 12.0));
                                float _e286 = reached;
                                float _e287 = wanted;
                                if ((_e286 < _e287)) {
                                    float _e291 = depth_1;
                                    float _e292 = wanted;
                                    local_6 = (_e291 >= _e292);
                                } else {
                                    local_6 = false;
                                }
                                bool _e295 = local_6;
                                if (_e295) {
                                    int _e297 = which;
                                    float _e299 = at_4;
                                    int _e301 = k_2;
                                    float _e303 = columns_along_1_distance_1_[_e301];
                                    float _e304 = at_4;
                                    float _e306 = wanted;
                                    float _e307 = reached;
                                    float _e310 = depth_1;
                                    float _e311 = reached;
                                    march_line_1_cuts[_e297] = (_e299 + (((_e303 - _e304) * (_e306 - _e307)) / (_e310 - _e311)));
                                }
                                int _e315 = which;
                                which = (_e315 + 1);
                                int _e318 = which;
                                int _e324 = which;
                                wanted = ((_e324 == 0) ? 0.5 : ((_e318 == 1) ? 3.0 : 12.0));
                                float _e329 = reached;
                                float _e330 = wanted;
                                if ((_e329 < _e330)) {
                                    float _e334 = depth_1;
                                    float _e335 = wanted;
                                    local_7 = (_e334 >= _e335);
                                } else {
                                    local_7 = false;
                                }
                                bool _e338 = local_7;
                                if (_e338) {
                                    int _e340 = which;
                                    float _e342 = at_4;
                                    int _e344 = k_2;
                                    float _e346 = columns_along_1_distance_1_[_e344];
                                    float _e347 = at_4;
                                    float _e349 = wanted;
                                    float _e350 = reached;
                                    float _e353 = depth_1;
                                    float _e354 = reached;
                                    march_line_1_cuts[_e340] = (_e342 + (((_e346 - _e347) * (_e349 - _e350)) / (_e353 - _e354)));
                                }
                                int _e358 = which;
                                which = (_e358 + 1);
                                int _e361 = which;
                                int _e367 = which;
                                wanted = ((_e367 == 0) ? 0.5 : ((_e361 == 1) ? 3.0 : 12.0));
                                float _e372 = reached;
                                float _e373 = wanted;
                                if ((_e372 < _e373)) {
                                    float _e377 = depth_1;
                                    float _e378 = wanted;
                                    local_8 = (_e377 >= _e378);
                                } else {
                                    local_8 = false;
                                }
                                bool _e381 = local_8;
                                if (_e381) {
                                    int _e383 = which;
                                    float _e385 = at_4;
                                    int _e387 = k_2;
                                    float _e389 = columns_along_1_distance_1_[_e387];
                                    float _e390 = at_4;
                                    float _e392 = wanted;
                                    float _e393 = reached;
                                    float _e396 = depth_1;
                                    float _e397 = reached;
                                    march_line_1_cuts[_e383] = (_e385 + (((_e389 - _e390) * (_e392 - _e393)) / (_e396 - _e397)));
                                }
                                int _e401 = which;
                                which = (_e401 + 1);
                                int _e404 = which;
                                int _e410 = which;
                                wanted = ((_e410 == 0) ? 0.5 : ((_e404 == 1) ? 3.0 : 12.0));
                                float _e415 = reached;
                                float _e416 = wanted;
                                if ((_e415 < _e416)) {
                                    float _e420 = depth_1;
                                    float _e421 = wanted;
                                    local_9 = (_e420 >= _e421);
                                } else {
                                    local_9 = false;
                                }
                                bool _e424 = local_9;
                                if (_e424) {
                                    int _e426 = which;
                                    float _e428 = at_4;
                                    int _e430 = k_2;
                                    float _e432 = columns_along_1_distance_1_[_e430];
                                    float _e433 = at_4;
                                    float _e435 = wanted;
                                    float _e436 = reached;
                                    float _e439 = depth_1;
                                    float _e440 = reached;
                                    march_line_1_cuts[_e426] = (_e428 + (((_e432 - _e433) * (_e435 - _e436)) / (_e439 - _e440)));
                                }
                            }
                        }
                        bool loop_init_14 = true;
                        while(true) {
                            if (!loop_init_14) {
                                int _e489 = which;
                                which = (_e489 + 1);
                            }
                            loop_init_14 = false;
                            int _e447 = which;
                            if ((_e447 < 3)) {
                            } else {
                                break;
                            }
                            {
                                int _e449 = which;
                                int _e455 = which;
                                wanted = ((_e455 == 0) ? 0.5 : ((_e449 == 1) ? 3.0 : 12.0));
                                float _e460 = reached;
                                float _e461 = wanted;
                                if ((_e460 < _e461)) {
                                    float _e465 = depth_1;
                                    float _e466 = wanted;
                                    local_10 = (_e465 >= _e466);
                                } else {
                                    local_10 = false;
                                }
                                bool _e469 = local_10;
                                if (_e469) {
                                    int _e471 = which;
                                    float _e473 = at_4;
                                    int _e475 = k_2;
                                    float _e477 = columns_along_1_distance_1_[_e475];
                                    float _e478 = at_4;
                                    float _e480 = wanted;
                                    float _e481 = reached;
                                    float _e484 = depth_1;
                                    float _e485 = reached;
                                    march_line_1_cuts[_e471] = (_e473 + (((_e477 - _e478) * (_e480 - _e481)) / (_e484 - _e485)));
                                }
                            }
                        }
                    }
                    float now_6_ = depth_1;
                    int _e494 = k_2;
                    float now_7_ = columns_along_1_distance_1_[_e494];
                    reached = now_6_;
                    at_4 = now_7_;
                }
            }
        }
    }
    float _e503 = reached;
    return _e503;
}

void place_panel_1_(float r_14, float mu_13, float start_3, float end_3, float length_1_3, int rule_2) {
    int n_2 = 0;
    bool descending_3 = false;
    float low_5 = 0.0;
    float beside_4 = 0.0;
    float first_4 = 0.0;
    float last_3 = 0.0;
    int k_3 = 0;
    float slope_2 = 0.0;
    int node_4 = 0;
    float share_2 = 0.0;
    int c_3 = 0;
    float here_2 = 0.0;
    float _e18 = read_rules(rule_2);
    n_2 = int(_e18);
    Several_bool_f32_f32_f32_f32_ _e20 = panel_leg(r_14, mu_13, start_3, end_3, length_1_3);
    descending_3 = _e20.v0_;
    low_5 = _e20.v1_;
    beside_4 = _e20.v2_;
    first_4 = _e20.v3_;
    last_3 = _e20.v4_;
    k_3 = 0;
    bool loop_init_15 = true;
    while(true) {
        if (!loop_init_15) {
            int _e258 = k_3;
            k_3 = (_e258 + 1);
        }
        loop_init_15 = false;
        int _e27 = k_3;
        int _e28 = n_2;
        if ((_e27 < _e28)) {
        } else {
            break;
        }
        {
            bool _e32 = descending_3;
            float _e33 = low_5;
            float _e34 = beside_4;
            float _e35 = first_4;
            float _e36 = last_3;
            int _e39 = k_3;
            float _e41 = read_rules(((rule_2 + 1) + _e39));
            Several_f32_f32_f32_ _e42 = panel_point((-(r_14) * mu_13), _e32, _e33, _e34, _e35, _e36, _e41);
            int _e44 = k_3;
            march_line_1_distance_1_[_e44] = _e42.v0_;
            int _e48 = k_3;
            march_line_1_radius[_e48] = _e42.v1_;
            slope_2 = _e42.v2_;
            int _e53 = k_3;
            float _e55 = slope_2;
            int _e58 = n_2;
            int _e60 = k_3;
            float _e62 = read_rules((((rule_2 + 1) + _e58) + _e60));
            march_line_1_weight[_e53] = (_e55 * _e62);
            int _e65 = k_3;
            float _e67 = march_line_1_radius[_e65];
            float _e71 = _group_0_binding_0_fs.shell.x;
            float _e75 = _group_0_binding_0_fs.shell.y;
            float _e79 = _group_0_binding_0_fs.shell.x;
            int _e82 = size_density(0);
            Several_i32_f32_ _e83 = density_place(_e67, _e71, (_e75 - _e79), _e82);
            node_4 = _e83.v0_;
            share_2 = _e83.v1_;
            float _e89 = _group_0_binding_0_fs.counts.x;
            int end_4_2 = int(_e89);
            c_3 = 0;
            bool loop_init_16 = true;
            while(true) {
                if (!loop_init_16) {
                    int _e221 = c_3;
                    c_3 = (_e221 + 1);
                }
                loop_init_16 = false;
                int _e92 = c_3;
                if (((_e92 + 3) < end_4_2)) {
                } else {
                    break;
                }
                {
                    int _e96 = node_4;
                    int _e98 = size_density(1);
                    int _e100 = c_3;
                    float _e102 = read_density(((_e96 * _e98) + _e100));
                    here_2 = _e102;
                    int _e104 = c_3;
                    int _e107 = k_3;
                    float _e110 = here_2;
                    int _e111 = node_4;
                    int _e115 = size_density(1);
                    int _e117 = c_3;
                    float _e119 = read_density((((_e111 + 1) * _e115) + _e117));
                    float _e120 = here_2;
                    float _e122 = share_2;
                    march_line_1_density[((_e104 * 24) + _e107)] = (_e110 + ((_e119 - _e120) * _e122));
                    int _e125 = c_3;
                    c_3 = (_e125 + 1);
                    int _e128 = node_4;
                    int _e130 = size_density(1);
                    int _e132 = c_3;
                    float _e134 = read_density(((_e128 * _e130) + _e132));
                    here_2 = _e134;
                    int _e136 = c_3;
                    int _e139 = k_3;
                    float _e142 = here_2;
                    int _e143 = node_4;
                    int _e147 = size_density(1);
                    int _e149 = c_3;
                    float _e151 = read_density((((_e143 + 1) * _e147) + _e149));
                    float _e152 = here_2;
                    float _e154 = share_2;
                    march_line_1_density[((_e136 * 24) + _e139)] = (_e142 + ((_e151 - _e152) * _e154));
                    int _e157 = c_3;
                    c_3 = (_e157 + 1);
                    int _e160 = node_4;
                    int _e162 = size_density(1);
                    int _e164 = c_3;
                    float _e166 = read_density(((_e160 * _e162) + _e164));
                    here_2 = _e166;
                    int _e168 = c_3;
                    int _e171 = k_3;
                    float _e174 = here_2;
                    int _e175 = node_4;
                    int _e179 = size_density(1);
                    int _e181 = c_3;
                    float _e183 = read_density((((_e175 + 1) * _e179) + _e181));
                    float _e184 = here_2;
                    float _e186 = share_2;
                    march_line_1_density[((_e168 * 24) + _e171)] = (_e174 + ((_e183 - _e184) * _e186));
                    int _e189 = c_3;
                    c_3 = (_e189 + 1);
                    int _e192 = node_4;
                    int _e194 = size_density(1);
                    int _e196 = c_3;
                    float _e198 = read_density(((_e192 * _e194) + _e196));
                    here_2 = _e198;
                    int _e200 = c_3;
                    int _e203 = k_3;
                    float _e206 = here_2;
                    int _e207 = node_4;
                    int _e211 = size_density(1);
                    int _e213 = c_3;
                    float _e215 = read_density((((_e207 + 1) * _e211) + _e213));
                    float _e216 = here_2;
                    float _e218 = share_2;
                    march_line_1_density[((_e200 * 24) + _e203)] = (_e206 + ((_e215 - _e216) * _e218));
                }
            }
            bool loop_init_17 = true;
            while(true) {
                if (!loop_init_17) {
                    int _e255 = c_3;
                    c_3 = (_e255 + 1);
                }
                loop_init_17 = false;
                int _e224 = c_3;
                if ((_e224 < end_4_2)) {
                } else {
                    break;
                }
                {
                    int _e226 = node_4;
                    int _e228 = size_density(1);
                    int _e230 = c_3;
                    float _e232 = read_density(((_e226 * _e228) + _e230));
                    here_2 = _e232;
                    int _e234 = c_3;
                    int _e237 = k_3;
                    float _e240 = here_2;
                    int _e241 = node_4;
                    int _e245 = size_density(1);
                    int _e247 = c_3;
                    float _e249 = read_density((((_e241 + 1) * _e245) + _e247));
                    float _e250 = here_2;
                    float _e252 = share_2;
                    march_line_1_density[((_e234 * 24) + _e237)] = (_e240 + ((_e249 - _e250) * _e252));
                }
            }
        }
    }
    return;
}

void panel_columns_1_(int rule_3) {
    int n_3 = 0;
    int c_4 = 0;
    int k_4 = 0;
    float running = 0.0;
    int j = 0;
    float share_3 = 0.0;
    float _e7 = read_rules(rule_3);
    n_3 = int(_e7);
    c_4 = 0;
    bool loop_init_18 = true;
    while(true) {
        if (!loop_init_18) {
            int _e291 = c_4;
            c_4 = (_e291 + 1);
        }
        loop_init_18 = false;
        int _e10 = c_4;
        float _e14 = _group_0_binding_0_fs.counts.x;
        if ((_e10 < int(_e14))) {
        } else {
            break;
        }
        {
            k_4 = 0;
            bool loop_init_19 = true;
            while(true) {
                if (!loop_init_19) {
                    int _e185 = k_4;
                    k_4 = (_e185 + 1);
                }
                loop_init_19 = false;
                int _e18 = k_4;
                int _e19 = n_3;
                if ((_e18 < _e19)) {
                } else {
                    break;
                }
                {
                    running = 0.0;
                    int end_1_1 = n_3;
                    j = 0;
                    bool loop_init_20 = true;
                    while(true) {
                        if (!loop_init_20) {
                            int _e137 = j;
                            j = (_e137 + 1);
                        }
                        loop_init_20 = false;
                        int _e24 = j;
                        if (((_e24 + 3) < end_1_1)) {
                        } else {
                            break;
                        }
                        {
                            int _e30 = n_3;
                            int _e34 = k_4;
                            int _e35 = n_3;
                            int _e38 = j;
                            float _e40 = read_rules(((((rule_3 + 1) + (2 * _e30)) + (_e34 * _e35)) + _e38));
                            share_3 = _e40;
                            float _e41 = running;
                            float _e42 = share_3;
                            int _e44 = c_4;
                            int _e47 = j;
                            float _e50 = march_line_1_amounts[((_e44 * 24) + _e47)];
                            running = (_e41 + (_e42 * _e50));
                            int _e53 = j;
                            j = (_e53 + 1);
                            int _e58 = n_3;
                            int _e62 = k_4;
                            int _e63 = n_3;
                            int _e66 = j;
                            float _e68 = read_rules(((((rule_3 + 1) + (2 * _e58)) + (_e62 * _e63)) + _e66));
                            share_3 = _e68;
                            float _e69 = running;
                            float _e70 = share_3;
                            int _e72 = c_4;
                            int _e75 = j;
                            float _e78 = march_line_1_amounts[((_e72 * 24) + _e75)];
                            running = (_e69 + (_e70 * _e78));
                            int _e81 = j;
                            j = (_e81 + 1);
                            int _e86 = n_3;
                            int _e90 = k_4;
                            int _e91 = n_3;
                            int _e94 = j;
                            float _e96 = read_rules(((((rule_3 + 1) + (2 * _e86)) + (_e90 * _e91)) + _e94));
                            share_3 = _e96;
                            float _e97 = running;
                            float _e98 = share_3;
                            int _e100 = c_4;
                            int _e103 = j;
                            float _e106 = march_line_1_amounts[((_e100 * 24) + _e103)];
                            running = (_e97 + (_e98 * _e106));
                            int _e109 = j;
                            j = (_e109 + 1);
                            int _e114 = n_3;
                            int _e118 = k_4;
                            int _e119 = n_3;
                            int _e122 = j;
                            float _e124 = read_rules(((((rule_3 + 1) + (2 * _e114)) + (_e118 * _e119)) + _e122));
                            share_3 = _e124;
                            float _e125 = running;
                            float _e126 = share_3;
                            int _e128 = c_4;
                            int _e131 = j;
                            float _e134 = march_line_1_amounts[((_e128 * 24) + _e131)];
                            running = (_e125 + (_e126 * _e134));
                        }
                    }
                    bool loop_init_21 = true;
                    while(true) {
                        if (!loop_init_21) {
                            int _e167 = j;
                            j = (_e167 + 1);
                        }
                        loop_init_21 = false;
                        int _e140 = j;
                        if ((_e140 < end_1_1)) {
                        } else {
                            break;
                        }
                        {
                            int _e144 = n_3;
                            int _e148 = k_4;
                            int _e149 = n_3;
                            int _e152 = j;
                            float _e154 = read_rules(((((rule_3 + 1) + (2 * _e144)) + (_e148 * _e149)) + _e152));
                            share_3 = _e154;
                            float _e155 = running;
                            float _e156 = share_3;
                            int _e158 = c_4;
                            int _e161 = j;
                            float _e164 = march_line_1_amounts[((_e158 * 24) + _e161)];
                            running = (_e155 + (_e156 * _e164));
                        }
                    }
                    int _e171 = c_4;
                    int _e174 = k_4;
                    int _e178 = c_4;
                    float _e180 = march_line_1_before[_e178];
                    float _e181 = running;
                    march_line_1_columns[((_e171 * 24) + _e174)] = (_e180 + max(_e181, 0.0));
                }
            }
            int end_2_ = n_3;
            k_4 = 0;
            bool loop_init_22 = true;
            while(true) {
                if (!loop_init_22) {
                    int _e267 = k_4;
                    k_4 = (_e267 + 1);
                }
                loop_init_22 = false;
                int _e190 = k_4;
                if (((_e190 + 3) < end_2_)) {
                } else {
                    break;
                }
                {
                    int _e195 = c_4;
                    int _e198 = c_4;
                    float _e200 = march_line_1_before[_e198];
                    int _e202 = c_4;
                    int _e205 = k_4;
                    float _e208 = march_line_1_amounts[((_e202 * 24) + _e205)];
                    march_line_1_before[_e195] = (_e200 + _e208);
                    int _e210 = k_4;
                    k_4 = (_e210 + 1);
                    int _e214 = c_4;
                    int _e217 = c_4;
                    float _e219 = march_line_1_before[_e217];
                    int _e221 = c_4;
                    int _e224 = k_4;
                    float _e227 = march_line_1_amounts[((_e221 * 24) + _e224)];
                    march_line_1_before[_e214] = (_e219 + _e227);
                    int _e229 = k_4;
                    k_4 = (_e229 + 1);
                    int _e233 = c_4;
                    int _e236 = c_4;
                    float _e238 = march_line_1_before[_e236];
                    int _e240 = c_4;
                    int _e243 = k_4;
                    float _e246 = march_line_1_amounts[((_e240 * 24) + _e243)];
                    march_line_1_before[_e233] = (_e238 + _e246);
                    int _e248 = k_4;
                    k_4 = (_e248 + 1);
                    int _e252 = c_4;
                    int _e255 = c_4;
                    float _e257 = march_line_1_before[_e255];
                    int _e259 = c_4;
                    int _e262 = k_4;
                    float _e265 = march_line_1_amounts[((_e259 * 24) + _e262)];
                    march_line_1_before[_e252] = (_e257 + _e265);
                }
            }
            bool loop_init_23 = true;
            while(true) {
                if (!loop_init_23) {
                    int _e288 = k_4;
                    k_4 = (_e288 + 1);
                }
                loop_init_23 = false;
                int _e270 = k_4;
                if ((_e270 < end_2_)) {
                } else {
                    break;
                }
                {
                    int _e273 = c_4;
                    int _e276 = c_4;
                    float _e278 = march_line_1_before[_e276];
                    int _e280 = c_4;
                    int _e283 = k_4;
                    float _e286 = march_line_1_amounts[((_e280 * 24) + _e283)];
                    march_line_1_before[_e273] = (_e278 + _e286);
                }
            }
        }
    }
    return;
}

vec4 through_columns_1_(int constituents) {
    vec4 tau = vec4(0.0);
    int c_5 = 0;
    tau = vec4(0.0);
    c_5 = 0;
    bool loop_init_24 = true;
    while(true) {
        if (!loop_init_24) {
            int _e71 = c_5;
            c_5 = (_e71 + 1);
        }
        loop_init_24 = false;
        int _e6 = c_5;
        if (((_e6 + 3) < constituents)) {
        } else {
            break;
        }
        {
            vec4 _e10 = tau;
            int _e11 = c_5;
            vec4 _e16 = read_extinction(((1 * _e11) + 0));
            int _e18 = c_5;
            float _e20 = march_line_1_depths[_e18];
            tau = (_e10 + (_e16 * _e20));
            int _e23 = c_5;
            c_5 = (_e23 + 1);
            vec4 _e26 = tau;
            int _e27 = c_5;
            vec4 _e32 = read_extinction(((1 * _e27) + 0));
            int _e34 = c_5;
            float _e36 = march_line_1_depths[_e34];
            tau = (_e26 + (_e32 * _e36));
            int _e39 = c_5;
            c_5 = (_e39 + 1);
            vec4 _e42 = tau;
            int _e43 = c_5;
            vec4 _e48 = read_extinction(((1 * _e43) + 0));
            int _e50 = c_5;
            float _e52 = march_line_1_depths[_e50];
            tau = (_e42 + (_e48 * _e52));
            int _e55 = c_5;
            c_5 = (_e55 + 1);
            vec4 _e58 = tau;
            int _e59 = c_5;
            vec4 _e64 = read_extinction(((1 * _e59) + 0));
            int _e66 = c_5;
            float _e68 = march_line_1_depths[_e66];
            tau = (_e58 + (_e64 * _e68));
        }
    }
    bool loop_init_25 = true;
    while(true) {
        if (!loop_init_25) {
            int _e89 = c_5;
            c_5 = (_e89 + 1);
        }
        loop_init_25 = false;
        int _e74 = c_5;
        if ((_e74 < constituents)) {
        } else {
            break;
        }
        {
            vec4 _e76 = tau;
            int _e77 = c_5;
            vec4 _e82 = read_extinction(((1 * _e77) + 0));
            int _e84 = c_5;
            float _e86 = march_line_1_depths[_e84];
            tau = (_e76 + (_e82 * _e86));
        }
    }
    vec4 _e92 = tau;
    return exp((vec4(0.0) - _e92));
}

void columns_to_top_1_(float r_15, float mu_14, float bottom_2, float top_2) {
    float x_19 = 0.0;
    int row_4 = 0;
    float f_2 = 0.0;
    int place_1 = 0;
    float e_1 = 0.0;
    float w00_1 = 0.0;
    float w01_1 = 0.0;
    float w10_1 = 0.0;
    float w11_1 = 0.0;
    float distance_1_3 = 0.0;
    int c_6 = 0;
    float scale = 0.0;
    float scaled = 0.0;
    float _e17 = altitude_coordinate(r_15, bottom_2, top_2);
    int _e19 = size_columns(0);
    x_19 = (_e17 * float((_e19 - 1)));
    float _e24 = x_19;
    int _e27 = size_columns(0);
    row_4 = min(int(_e24), (_e27 - 2));
    float _e31 = x_19;
    int _e32 = row_4;
    f_2 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_15, mu_14, bottom_2, top_2);
    int _e37 = size_columns(1);
    x_19 = (_e35 * float((_e37 - 1)));
    float _e42 = x_19;
    int _e45 = size_columns(1);
    place_1 = min(int(_e42), (_e45 - 2));
    float _e49 = x_19;
    int _e50 = place_1;
    e_1 = (_e49 - float(_e50));
    float _e53 = f_2;
    float _e56 = e_1;
    float now_1_1 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_2;
    float _e63 = e_1;
    float now_2_1 = ((1.0 - _e60) * _e63);
    w00_1 = now_1_1;
    w01_1 = now_2_1;
    float _e65 = f_2;
    float _e66 = e_1;
    float now_3_1 = (_e65 * (1.0 - _e66));
    float _e70 = f_2;
    float _e71 = e_1;
    float now_4_1 = (_e70 * _e71);
    w10_1 = now_3_1;
    w11_1 = now_4_1;
    float _e73 = distance_to_top(r_15, mu_14, top_2);
    distance_1_3 = _e73;
    int _e75 = size_columns(2);
    c_6 = 0;
    bool loop_init_26 = true;
    while(true) {
        if (!loop_init_26) {
            int _e818 = c_6;
            c_6 = (_e818 + 1);
        }
        loop_init_26 = false;
        int _e77 = c_6;
        if (((_e77 + 3) < _e75)) {
        } else {
            break;
        }
        {
            float _e81 = w00_1;
            int _e82 = row_4;
            int _e84 = size_columns(1);
            int _e86 = place_1;
            int _e89 = size_columns(2);
            int _e91 = c_6;
            int _e94 = size_columns(3);
            float _e98 = read_columns(((((((_e82 * _e84) + _e86) * _e89) + _e91) * _e94) + 0));
            float _e100 = w01_1;
            int _e101 = row_4;
            int _e103 = size_columns(1);
            int _e105 = place_1;
            int _e110 = size_columns(2);
            int _e112 = c_6;
            int _e115 = size_columns(3);
            float _e119 = read_columns(((((((_e101 * _e103) + (_e105 + 1)) * _e110) + _e112) * _e115) + 0));
            float _e122 = w10_1;
            int _e123 = row_4;
            int _e127 = size_columns(1);
            int _e129 = place_1;
            int _e132 = size_columns(2);
            int _e134 = c_6;
            int _e137 = size_columns(3);
            float _e141 = read_columns((((((((_e123 + 1) * _e127) + _e129) * _e132) + _e134) * _e137) + 0));
            float _e144 = w11_1;
            int _e145 = row_4;
            int _e149 = size_columns(1);
            int _e151 = place_1;
            int _e156 = size_columns(2);
            int _e158 = c_6;
            int _e161 = size_columns(3);
            float _e165 = read_columns((((((((_e145 + 1) * _e149) + (_e151 + 1)) * _e156) + _e158) * _e161) + 0));
            scale = ((((_e81 * _e98) + (_e100 * _e119)) + (_e122 * _e141)) + (_e144 * _e165));
            float _e168 = w00_1;
            int _e169 = row_4;
            int _e171 = size_columns(1);
            int _e173 = place_1;
            int _e176 = size_columns(2);
            int _e178 = c_6;
            int _e181 = size_columns(3);
            float _e185 = read_columns(((((((_e169 * _e171) + _e173) * _e176) + _e178) * _e181) + 1));
            float _e187 = w01_1;
            int _e188 = row_4;
            int _e190 = size_columns(1);
            int _e192 = place_1;
            int _e197 = size_columns(2);
            int _e199 = c_6;
            int _e202 = size_columns(3);
            float _e206 = read_columns(((((((_e188 * _e190) + (_e192 + 1)) * _e197) + _e199) * _e202) + 1));
            float _e209 = w10_1;
            int _e210 = row_4;
            int _e214 = size_columns(1);
            int _e216 = place_1;
            int _e219 = size_columns(2);
            int _e221 = c_6;
            int _e224 = size_columns(3);
            float _e228 = read_columns((((((((_e210 + 1) * _e214) + _e216) * _e219) + _e221) * _e224) + 1));
            float _e231 = w11_1;
            int _e232 = row_4;
            int _e236 = size_columns(1);
            int _e238 = place_1;
            int _e243 = size_columns(2);
            int _e245 = c_6;
            int _e248 = size_columns(3);
            float _e252 = read_columns((((((((_e232 + 1) * _e236) + (_e238 + 1)) * _e243) + _e245) * _e248) + 1));
            scaled = ((((_e168 * _e185) + (_e187 * _e206)) + (_e209 * _e228)) + (_e231 * _e252));
            int _e256 = c_6;
            float _e258 = distance_1_3;
            float _e259 = scaled;
            float _e261 = scale;
            march_line_1_here[_e256] = ((_e258 * _e259) / _e261);
            int _e263 = c_6;
            c_6 = (_e263 + 1);
            float _e266 = w00_1;
            int _e267 = row_4;
            int _e269 = size_columns(1);
            int _e271 = place_1;
            int _e274 = size_columns(2);
            int _e276 = c_6;
            int _e279 = size_columns(3);
            float _e283 = read_columns(((((((_e267 * _e269) + _e271) * _e274) + _e276) * _e279) + 0));
            float _e285 = w01_1;
            int _e286 = row_4;
            int _e288 = size_columns(1);
            int _e290 = place_1;
            int _e295 = size_columns(2);
            int _e297 = c_6;
            int _e300 = size_columns(3);
            float _e304 = read_columns(((((((_e286 * _e288) + (_e290 + 1)) * _e295) + _e297) * _e300) + 0));
            float _e307 = w10_1;
            int _e308 = row_4;
            int _e312 = size_columns(1);
            int _e314 = place_1;
            int _e317 = size_columns(2);
            int _e319 = c_6;
            int _e322 = size_columns(3);
            float _e326 = read_columns((((((((_e308 + 1) * _e312) + _e314) * _e317) + _e319) * _e322) + 0));
            float _e329 = w11_1;
            int _e330 = row_4;
            int _e334 = size_columns(1);
            int _e336 = place_1;
            int _e341 = size_columns(2);
            int _e343 = c_6;
            int _e346 = size_columns(3);
            float _e350 = read_columns((((((((_e330 + 1) * _e334) + (_e336 + 1)) * _e341) + _e343) * _e346) + 0));
            scale = ((((_e266 * _e283) + (_e285 * _e304)) + (_e307 * _e326)) + (_e329 * _e350));
            float _e353 = w00_1;
            int _e354 = row_4;
            int _e356 = size_columns(1);
            int _e358 = place_1;
            int _e361 = size_columns(2);
            int _e363 = c_6;
            int _e366 = size_columns(3);
            float _e370 = read_columns(((((((_e354 * _e356) + _e358) * _e361) + _e363) * _e366) + 1));
            float _e372 = w01_1;
            int _e373 = row_4;
            int _e375 = size_columns(1);
            int _e377 = place_1;
            int _e382 = size_columns(2);
            int _e384 = c_6;
            int _e387 = size_columns(3);
            float _e391 = read_columns(((((((_e373 * _e375) + (_e377 + 1)) * _e382) + _e384) * _e387) + 1));
            float _e394 = w10_1;
            int _e395 = row_4;
            int _e399 = size_columns(1);
            int _e401 = place_1;
            int _e404 = size_columns(2);
            int _e406 = c_6;
            int _e409 = size_columns(3);
            float _e413 = read_columns((((((((_e395 + 1) * _e399) + _e401) * _e404) + _e406) * _e409) + 1));
            float _e416 = w11_1;
            int _e417 = row_4;
            int _e421 = size_columns(1);
            int _e423 = place_1;
            int _e428 = size_columns(2);
            int _e430 = c_6;
            int _e433 = size_columns(3);
            float _e437 = read_columns((((((((_e417 + 1) * _e421) + (_e423 + 1)) * _e428) + _e430) * _e433) + 1));
            scaled = ((((_e353 * _e370) + (_e372 * _e391)) + (_e394 * _e413)) + (_e416 * _e437));
            int _e441 = c_6;
            float _e443 = distance_1_3;
            float _e444 = scaled;
            float _e446 = scale;
            march_line_1_here[_e441] = ((_e443 * _e444) / _e446);
            int _e448 = c_6;
            c_6 = (_e448 + 1);
            float _e451 = w00_1;
            int _e452 = row_4;
            int _e454 = size_columns(1);
            int _e456 = place_1;
            int _e459 = size_columns(2);
            int _e461 = c_6;
            int _e464 = size_columns(3);
            float _e468 = read_columns(((((((_e452 * _e454) + _e456) * _e459) + _e461) * _e464) + 0));
            float _e470 = w01_1;
            int _e471 = row_4;
            int _e473 = size_columns(1);
            int _e475 = place_1;
            int _e480 = size_columns(2);
            int _e482 = c_6;
            int _e485 = size_columns(3);
            float _e489 = read_columns(((((((_e471 * _e473) + (_e475 + 1)) * _e480) + _e482) * _e485) + 0));
            float _e492 = w10_1;
            int _e493 = row_4;
            int _e497 = size_columns(1);
            int _e499 = place_1;
            int _e502 = size_columns(2);
            int _e504 = c_6;
            int _e507 = size_columns(3);
            float _e511 = read_columns((((((((_e493 + 1) * _e497) + _e499) * _e502) + _e504) * _e507) + 0));
            float _e514 = w11_1;
            int _e515 = row_4;
            int _e519 = size_columns(1);
            int _e521 = place_1;
            int _e526 = size_columns(2);
            int _e528 = c_6;
            int _e531 = size_columns(3);
            float _e535 = read_columns((((((((_e515 + 1) * _e519) + (_e521 + 1)) * _e526) + _e528) * _e531) + 0));
            scale = ((((_e451 * _e468) + (_e470 * _e489)) + (_e492 * _e511)) + (_e514 * _e535));
            float _e538 = w00_1;
            int _e539 = row_4;
            int _e541 = size_columns(1);
            int _e543 = place_1;
            int _e546 = size_columns(2);
            int _e548 = c_6;
            int _e551 = size_columns(3);
            float _e555 = read_columns(((((((_e539 * _e541) + _e543) * _e546) + _e548) * _e551) + 1));
            float _e557 = w01_1;
            int _e558 = row_4;
            int _e560 = size_columns(1);
            int _e562 = place_1;
            int _e567 = size_columns(2);
            int _e569 = c_6;
            int _e572 = size_columns(3);
            float _e576 = read_columns(((((((_e558 * _e560) + (_e562 + 1)) * _e567) + _e569) * _e572) + 1));
            float _e579 = w10_1;
            int _e580 = row_4;
            int _e584 = size_columns(1);
            int _e586 = place_1;
            int _e589 = size_columns(2);
            int _e591 = c_6;
            int _e594 = size_columns(3);
            float _e598 = read_columns((((((((_e580 + 1) * _e584) + _e586) * _e589) + _e591) * _e594) + 1));
            float _e601 = w11_1;
            int _e602 = row_4;
            int _e606 = size_columns(1);
            int _e608 = place_1;
            int _e613 = size_columns(2);
            int _e615 = c_6;
            int _e618 = size_columns(3);
            float _e622 = read_columns((((((((_e602 + 1) * _e606) + (_e608 + 1)) * _e613) + _e615) * _e618) + 1));
            scaled = ((((_e538 * _e555) + (_e557 * _e576)) + (_e579 * _e598)) + (_e601 * _e622));
            int _e626 = c_6;
            float _e628 = distance_1_3;
            float _e629 = scaled;
            float _e631 = scale;
            march_line_1_here[_e626] = ((_e628 * _e629) / _e631);
            int _e633 = c_6;
            c_6 = (_e633 + 1);
            float _e636 = w00_1;
            int _e637 = row_4;
            int _e639 = size_columns(1);
            int _e641 = place_1;
            int _e644 = size_columns(2);
            int _e646 = c_6;
            int _e649 = size_columns(3);
            float _e653 = read_columns(((((((_e637 * _e639) + _e641) * _e644) + _e646) * _e649) + 0));
            float _e655 = w01_1;
            int _e656 = row_4;
            int _e658 = size_columns(1);
            int _e660 = place_1;
            int _e665 = size_columns(2);
            int _e667 = c_6;
            int _e670 = size_columns(3);
            float _e674 = read_columns(((((((_e656 * _e658) + (_e660 + 1)) * _e665) + _e667) * _e670) + 0));
            float _e677 = w10_1;
            int _e678 = row_4;
            int _e682 = size_columns(1);
            int _e684 = place_1;
            int _e687 = size_columns(2);
            int _e689 = c_6;
            int _e692 = size_columns(3);
            float _e696 = read_columns((((((((_e678 + 1) * _e682) + _e684) * _e687) + _e689) * _e692) + 0));
            float _e699 = w11_1;
            int _e700 = row_4;
            int _e704 = size_columns(1);
            int _e706 = place_1;
            int _e711 = size_columns(2);
            int _e713 = c_6;
            int _e716 = size_columns(3);
            float _e720 = read_columns((((((((_e700 + 1) * _e704) + (_e706 + 1)) * _e711) + _e713) * _e716) + 0));
            scale = ((((_e636 * _e653) + (_e655 * _e674)) + (_e677 * _e696)) + (_e699 * _e720));
            float _e723 = w00_1;
            int _e724 = row_4;
            int _e726 = size_columns(1);
            int _e728 = place_1;
            int _e731 = size_columns(2);
            int _e733 = c_6;
            int _e736 = size_columns(3);
            float _e740 = read_columns(((((((_e724 * _e726) + _e728) * _e731) + _e733) * _e736) + 1));
            float _e742 = w01_1;
            int _e743 = row_4;
            int _e745 = size_columns(1);
            int _e747 = place_1;
            int _e752 = size_columns(2);
            int _e754 = c_6;
            int _e757 = size_columns(3);
            float _e761 = read_columns(((((((_e743 * _e745) + (_e747 + 1)) * _e752) + _e754) * _e757) + 1));
            float _e764 = w10_1;
            int _e765 = row_4;
            int _e769 = size_columns(1);
            int _e771 = place_1;
            int _e774 = size_columns(2);
            int _e776 = c_6;
            int _e779 = size_columns(3);
            float _e783 = read_columns((((((((_e765 + 1) * _e769) + _e771) * _e774) + _e776) * _e779) + 1));
            float _e786 = w11_1;
            int _e787 = row_4;
            int _e791 = size_columns(1);
            int _e793 = place_1;
            int _e798 = size_columns(2);
            int _e800 = c_6;
            int _e803 = size_columns(3);
            float _e807 = read_columns((((((((_e787 + 1) * _e791) + (_e793 + 1)) * _e798) + _e800) * _e803) + 1));
            scaled = ((((_e723 * _e740) + (_e742 * _e761)) + (_e764 * _e783)) + (_e786 * _e807));
            int _e811 = c_6;
            float _e813 = distance_1_3;
            float _e814 = scaled;
            float _e816 = scale;
            march_line_1_here[_e811] = ((_e813 * _e814) / _e816);
        }
    }
    bool loop_init_27 = true;
    while(true) {
        if (!loop_init_27) {
            int _e1005 = c_6;
            c_6 = (_e1005 + 1);
        }
        loop_init_27 = false;
        int _e821 = c_6;
        if ((_e821 < _e75)) {
        } else {
            break;
        }
        {
            float _e823 = w00_1;
            int _e824 = row_4;
            int _e826 = size_columns(1);
            int _e828 = place_1;
            int _e831 = size_columns(2);
            int _e833 = c_6;
            int _e836 = size_columns(3);
            float _e840 = read_columns(((((((_e824 * _e826) + _e828) * _e831) + _e833) * _e836) + 0));
            float _e842 = w01_1;
            int _e843 = row_4;
            int _e845 = size_columns(1);
            int _e847 = place_1;
            int _e852 = size_columns(2);
            int _e854 = c_6;
            int _e857 = size_columns(3);
            float _e861 = read_columns(((((((_e843 * _e845) + (_e847 + 1)) * _e852) + _e854) * _e857) + 0));
            float _e864 = w10_1;
            int _e865 = row_4;
            int _e869 = size_columns(1);
            int _e871 = place_1;
            int _e874 = size_columns(2);
            int _e876 = c_6;
            int _e879 = size_columns(3);
            float _e883 = read_columns((((((((_e865 + 1) * _e869) + _e871) * _e874) + _e876) * _e879) + 0));
            float _e886 = w11_1;
            int _e887 = row_4;
            int _e891 = size_columns(1);
            int _e893 = place_1;
            int _e898 = size_columns(2);
            int _e900 = c_6;
            int _e903 = size_columns(3);
            float _e907 = read_columns((((((((_e887 + 1) * _e891) + (_e893 + 1)) * _e898) + _e900) * _e903) + 0));
            scale = ((((_e823 * _e840) + (_e842 * _e861)) + (_e864 * _e883)) + (_e886 * _e907));
            float _e910 = w00_1;
            int _e911 = row_4;
            int _e913 = size_columns(1);
            int _e915 = place_1;
            int _e918 = size_columns(2);
            int _e920 = c_6;
            int _e923 = size_columns(3);
            float _e927 = read_columns(((((((_e911 * _e913) + _e915) * _e918) + _e920) * _e923) + 1));
            float _e929 = w01_1;
            int _e930 = row_4;
            int _e932 = size_columns(1);
            int _e934 = place_1;
            int _e939 = size_columns(2);
            int _e941 = c_6;
            int _e944 = size_columns(3);
            float _e948 = read_columns(((((((_e930 * _e932) + (_e934 + 1)) * _e939) + _e941) * _e944) + 1));
            float _e951 = w10_1;
            int _e952 = row_4;
            int _e956 = size_columns(1);
            int _e958 = place_1;
            int _e961 = size_columns(2);
            int _e963 = c_6;
            int _e966 = size_columns(3);
            float _e970 = read_columns((((((((_e952 + 1) * _e956) + _e958) * _e961) + _e963) * _e966) + 1));
            float _e973 = w11_1;
            int _e974 = row_4;
            int _e978 = size_columns(1);
            int _e980 = place_1;
            int _e985 = size_columns(2);
            int _e987 = c_6;
            int _e990 = size_columns(3);
            float _e994 = read_columns((((((((_e974 + 1) * _e978) + (_e980 + 1)) * _e985) + _e987) * _e990) + 1));
            scaled = ((((_e910 * _e927) + (_e929 * _e948)) + (_e951 * _e970)) + (_e973 * _e994));
            int _e998 = c_6;
            float _e1000 = distance_1_3;
            float _e1001 = scaled;
            float _e1003 = scale;
            march_line_1_here[_e998] = ((_e1000 * _e1001) / _e1003);
        }
    }
    return;
}

void columns_to_top_2_(float r_16, float mu_15, float bottom_3, float top_3) {
    float x_20 = 0.0;
    int row_5 = 0;
    float f_3 = 0.0;
    int place_2 = 0;
    float e_2 = 0.0;
    float w00_2 = 0.0;
    float w01_2 = 0.0;
    float w10_2 = 0.0;
    float w11_2 = 0.0;
    float distance_1_4 = 0.0;
    int c_7 = 0;
    float scale_1 = 0.0;
    float scaled_1 = 0.0;
    float _e17 = altitude_coordinate(r_16, bottom_3, top_3);
    int _e19 = size_columns(0);
    x_20 = (_e17 * float((_e19 - 1)));
    float _e24 = x_20;
    int _e27 = size_columns(0);
    row_5 = min(int(_e24), (_e27 - 2));
    float _e31 = x_20;
    int _e32 = row_5;
    f_3 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_16, mu_15, bottom_3, top_3);
    int _e37 = size_columns(1);
    x_20 = (_e35 * float((_e37 - 1)));
    float _e42 = x_20;
    int _e45 = size_columns(1);
    place_2 = min(int(_e42), (_e45 - 2));
    float _e49 = x_20;
    int _e50 = place_2;
    e_2 = (_e49 - float(_e50));
    float _e53 = f_3;
    float _e56 = e_2;
    float now_1_2 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_3;
    float _e63 = e_2;
    float now_2_2 = ((1.0 - _e60) * _e63);
    w00_2 = now_1_2;
    w01_2 = now_2_2;
    float _e65 = f_3;
    float _e66 = e_2;
    float now_3_2 = (_e65 * (1.0 - _e66));
    float _e70 = f_3;
    float _e71 = e_2;
    float now_4_2 = (_e70 * _e71);
    w10_2 = now_3_2;
    w11_2 = now_4_2;
    float _e73 = distance_to_top(r_16, mu_15, top_3);
    distance_1_4 = _e73;
    int _e75 = size_columns(2);
    c_7 = 0;
    bool loop_init_28 = true;
    while(true) {
        if (!loop_init_28) {
            int _e818 = c_7;
            c_7 = (_e818 + 1);
        }
        loop_init_28 = false;
        int _e77 = c_7;
        if (((_e77 + 3) < _e75)) {
        } else {
            break;
        }
        {
            float _e81 = w00_2;
            int _e82 = row_5;
            int _e84 = size_columns(1);
            int _e86 = place_2;
            int _e89 = size_columns(2);
            int _e91 = c_7;
            int _e94 = size_columns(3);
            float _e98 = read_columns(((((((_e82 * _e84) + _e86) * _e89) + _e91) * _e94) + 0));
            float _e100 = w01_2;
            int _e101 = row_5;
            int _e103 = size_columns(1);
            int _e105 = place_2;
            int _e110 = size_columns(2);
            int _e112 = c_7;
            int _e115 = size_columns(3);
            float _e119 = read_columns(((((((_e101 * _e103) + (_e105 + 1)) * _e110) + _e112) * _e115) + 0));
            float _e122 = w10_2;
            int _e123 = row_5;
            int _e127 = size_columns(1);
            int _e129 = place_2;
            int _e132 = size_columns(2);
            int _e134 = c_7;
            int _e137 = size_columns(3);
            float _e141 = read_columns((((((((_e123 + 1) * _e127) + _e129) * _e132) + _e134) * _e137) + 0));
            float _e144 = w11_2;
            int _e145 = row_5;
            int _e149 = size_columns(1);
            int _e151 = place_2;
            int _e156 = size_columns(2);
            int _e158 = c_7;
            int _e161 = size_columns(3);
            float _e165 = read_columns((((((((_e145 + 1) * _e149) + (_e151 + 1)) * _e156) + _e158) * _e161) + 0));
            scale_1 = ((((_e81 * _e98) + (_e100 * _e119)) + (_e122 * _e141)) + (_e144 * _e165));
            float _e168 = w00_2;
            int _e169 = row_5;
            int _e171 = size_columns(1);
            int _e173 = place_2;
            int _e176 = size_columns(2);
            int _e178 = c_7;
            int _e181 = size_columns(3);
            float _e185 = read_columns(((((((_e169 * _e171) + _e173) * _e176) + _e178) * _e181) + 1));
            float _e187 = w01_2;
            int _e188 = row_5;
            int _e190 = size_columns(1);
            int _e192 = place_2;
            int _e197 = size_columns(2);
            int _e199 = c_7;
            int _e202 = size_columns(3);
            float _e206 = read_columns(((((((_e188 * _e190) + (_e192 + 1)) * _e197) + _e199) * _e202) + 1));
            float _e209 = w10_2;
            int _e210 = row_5;
            int _e214 = size_columns(1);
            int _e216 = place_2;
            int _e219 = size_columns(2);
            int _e221 = c_7;
            int _e224 = size_columns(3);
            float _e228 = read_columns((((((((_e210 + 1) * _e214) + _e216) * _e219) + _e221) * _e224) + 1));
            float _e231 = w11_2;
            int _e232 = row_5;
            int _e236 = size_columns(1);
            int _e238 = place_2;
            int _e243 = size_columns(2);
            int _e245 = c_7;
            int _e248 = size_columns(3);
            float _e252 = read_columns((((((((_e232 + 1) * _e236) + (_e238 + 1)) * _e243) + _e245) * _e248) + 1));
            scaled_1 = ((((_e168 * _e185) + (_e187 * _e206)) + (_e209 * _e228)) + (_e231 * _e252));
            int _e256 = c_7;
            float _e258 = distance_1_4;
            float _e259 = scaled_1;
            float _e261 = scale_1;
            march_line_1_there[_e256] = ((_e258 * _e259) / _e261);
            int _e263 = c_7;
            c_7 = (_e263 + 1);
            float _e266 = w00_2;
            int _e267 = row_5;
            int _e269 = size_columns(1);
            int _e271 = place_2;
            int _e274 = size_columns(2);
            int _e276 = c_7;
            int _e279 = size_columns(3);
            float _e283 = read_columns(((((((_e267 * _e269) + _e271) * _e274) + _e276) * _e279) + 0));
            float _e285 = w01_2;
            int _e286 = row_5;
            int _e288 = size_columns(1);
            int _e290 = place_2;
            int _e295 = size_columns(2);
            int _e297 = c_7;
            int _e300 = size_columns(3);
            float _e304 = read_columns(((((((_e286 * _e288) + (_e290 + 1)) * _e295) + _e297) * _e300) + 0));
            float _e307 = w10_2;
            int _e308 = row_5;
            int _e312 = size_columns(1);
            int _e314 = place_2;
            int _e317 = size_columns(2);
            int _e319 = c_7;
            int _e322 = size_columns(3);
            float _e326 = read_columns((((((((_e308 + 1) * _e312) + _e314) * _e317) + _e319) * _e322) + 0));
            float _e329 = w11_2;
            int _e330 = row_5;
            int _e334 = size_columns(1);
            int _e336 = place_2;
            int _e341 = size_columns(2);
            int _e343 = c_7;
            int _e346 = size_columns(3);
            float _e350 = read_columns((((((((_e330 + 1) * _e334) + (_e336 + 1)) * _e341) + _e343) * _e346) + 0));
            scale_1 = ((((_e266 * _e283) + (_e285 * _e304)) + (_e307 * _e326)) + (_e329 * _e350));
            float _e353 = w00_2;
            int _e354 = row_5;
            int _e356 = size_columns(1);
            int _e358 = place_2;
            int _e361 = size_columns(2);
            int _e363 = c_7;
            int _e366 = size_columns(3);
            float _e370 = read_columns(((((((_e354 * _e356) + _e358) * _e361) + _e363) * _e366) + 1));
            float _e372 = w01_2;
            int _e373 = row_5;
            int _e375 = size_columns(1);
            int _e377 = place_2;
            int _e382 = size_columns(2);
            int _e384 = c_7;
            int _e387 = size_columns(3);
            float _e391 = read_columns(((((((_e373 * _e375) + (_e377 + 1)) * _e382) + _e384) * _e387) + 1));
            float _e394 = w10_2;
            int _e395 = row_5;
            int _e399 = size_columns(1);
            int _e401 = place_2;
            int _e404 = size_columns(2);
            int _e406 = c_7;
            int _e409 = size_columns(3);
            float _e413 = read_columns((((((((_e395 + 1) * _e399) + _e401) * _e404) + _e406) * _e409) + 1));
            float _e416 = w11_2;
            int _e417 = row_5;
            int _e421 = size_columns(1);
            int _e423 = place_2;
            int _e428 = size_columns(2);
            int _e430 = c_7;
            int _e433 = size_columns(3);
            float _e437 = read_columns((((((((_e417 + 1) * _e421) + (_e423 + 1)) * _e428) + _e430) * _e433) + 1));
            scaled_1 = ((((_e353 * _e370) + (_e372 * _e391)) + (_e394 * _e413)) + (_e416 * _e437));
            int _e441 = c_7;
            float _e443 = distance_1_4;
            float _e444 = scaled_1;
            float _e446 = scale_1;
            march_line_1_there[_e441] = ((_e443 * _e444) / _e446);
            int _e448 = c_7;
            c_7 = (_e448 + 1);
            float _e451 = w00_2;
            int _e452 = row_5;
            int _e454 = size_columns(1);
            int _e456 = place_2;
            int _e459 = size_columns(2);
            int _e461 = c_7;
            int _e464 = size_columns(3);
            float _e468 = read_columns(((((((_e452 * _e454) + _e456) * _e459) + _e461) * _e464) + 0));
            float _e470 = w01_2;
            int _e471 = row_5;
            int _e473 = size_columns(1);
            int _e475 = place_2;
            int _e480 = size_columns(2);
            int _e482 = c_7;
            int _e485 = size_columns(3);
            float _e489 = read_columns(((((((_e471 * _e473) + (_e475 + 1)) * _e480) + _e482) * _e485) + 0));
            float _e492 = w10_2;
            int _e493 = row_5;
            int _e497 = size_columns(1);
            int _e499 = place_2;
            int _e502 = size_columns(2);
            int _e504 = c_7;
            int _e507 = size_columns(3);
            float _e511 = read_columns((((((((_e493 + 1) * _e497) + _e499) * _e502) + _e504) * _e507) + 0));
            float _e514 = w11_2;
            int _e515 = row_5;
            int _e519 = size_columns(1);
            int _e521 = place_2;
            int _e526 = size_columns(2);
            int _e528 = c_7;
            int _e531 = size_columns(3);
            float _e535 = read_columns((((((((_e515 + 1) * _e519) + (_e521 + 1)) * _e526) + _e528) * _e531) + 0));
            scale_1 = ((((_e451 * _e468) + (_e470 * _e489)) + (_e492 * _e511)) + (_e514 * _e535));
            float _e538 = w00_2;
            int _e539 = row_5;
            int _e541 = size_columns(1);
            int _e543 = place_2;
            int _e546 = size_columns(2);
            int _e548 = c_7;
            int _e551 = size_columns(3);
            float _e555 = read_columns(((((((_e539 * _e541) + _e543) * _e546) + _e548) * _e551) + 1));
            float _e557 = w01_2;
            int _e558 = row_5;
            int _e560 = size_columns(1);
            int _e562 = place_2;
            int _e567 = size_columns(2);
            int _e569 = c_7;
            int _e572 = size_columns(3);
            float _e576 = read_columns(((((((_e558 * _e560) + (_e562 + 1)) * _e567) + _e569) * _e572) + 1));
            float _e579 = w10_2;
            int _e580 = row_5;
            int _e584 = size_columns(1);
            int _e586 = place_2;
            int _e589 = size_columns(2);
            int _e591 = c_7;
            int _e594 = size_columns(3);
            float _e598 = read_columns((((((((_e580 + 1) * _e584) + _e586) * _e589) + _e591) * _e594) + 1));
            float _e601 = w11_2;
            int _e602 = row_5;
            int _e606 = size_columns(1);
            int _e608 = place_2;
            int _e613 = size_columns(2);
            int _e615 = c_7;
            int _e618 = size_columns(3);
            float _e622 = read_columns((((((((_e602 + 1) * _e606) + (_e608 + 1)) * _e613) + _e615) * _e618) + 1));
            scaled_1 = ((((_e538 * _e555) + (_e557 * _e576)) + (_e579 * _e598)) + (_e601 * _e622));
            int _e626 = c_7;
            float _e628 = distance_1_4;
            float _e629 = scaled_1;
            float _e631 = scale_1;
            march_line_1_there[_e626] = ((_e628 * _e629) / _e631);
            int _e633 = c_7;
            c_7 = (_e633 + 1);
            float _e636 = w00_2;
            int _e637 = row_5;
            int _e639 = size_columns(1);
            int _e641 = place_2;
            int _e644 = size_columns(2);
            int _e646 = c_7;
            int _e649 = size_columns(3);
            float _e653 = read_columns(((((((_e637 * _e639) + _e641) * _e644) + _e646) * _e649) + 0));
            float _e655 = w01_2;
            int _e656 = row_5;
            int _e658 = size_columns(1);
            int _e660 = place_2;
            int _e665 = size_columns(2);
            int _e667 = c_7;
            int _e670 = size_columns(3);
            float _e674 = read_columns(((((((_e656 * _e658) + (_e660 + 1)) * _e665) + _e667) * _e670) + 0));
            float _e677 = w10_2;
            int _e678 = row_5;
            int _e682 = size_columns(1);
            int _e684 = place_2;
            int _e687 = size_columns(2);
            int _e689 = c_7;
            int _e692 = size_columns(3);
            float _e696 = read_columns((((((((_e678 + 1) * _e682) + _e684) * _e687) + _e689) * _e692) + 0));
            float _e699 = w11_2;
            int _e700 = row_5;
            int _e704 = size_columns(1);
            int _e706 = place_2;
            int _e711 = size_columns(2);
            int _e713 = c_7;
            int _e716 = size_columns(3);
            float _e720 = read_columns((((((((_e700 + 1) * _e704) + (_e706 + 1)) * _e711) + _e713) * _e716) + 0));
            scale_1 = ((((_e636 * _e653) + (_e655 * _e674)) + (_e677 * _e696)) + (_e699 * _e720));
            float _e723 = w00_2;
            int _e724 = row_5;
            int _e726 = size_columns(1);
            int _e728 = place_2;
            int _e731 = size_columns(2);
            int _e733 = c_7;
            int _e736 = size_columns(3);
            float _e740 = read_columns(((((((_e724 * _e726) + _e728) * _e731) + _e733) * _e736) + 1));
            float _e742 = w01_2;
            int _e743 = row_5;
            int _e745 = size_columns(1);
            int _e747 = place_2;
            int _e752 = size_columns(2);
            int _e754 = c_7;
            int _e757 = size_columns(3);
            float _e761 = read_columns(((((((_e743 * _e745) + (_e747 + 1)) * _e752) + _e754) * _e757) + 1));
            float _e764 = w10_2;
            int _e765 = row_5;
            int _e769 = size_columns(1);
            int _e771 = place_2;
            int _e774 = size_columns(2);
            int _e776 = c_7;
            int _e779 = size_columns(3);
            float _e783 = read_columns((((((((_e765 + 1) * _e769) + _e771) * _e774) + _e776) * _e779) + 1));
            float _e786 = w11_2;
            int _e787 = row_5;
            int _e791 = size_columns(1);
            int _e793 = place_2;
            int _e798 = size_columns(2);
            int _e800 = c_7;
            int _e803 = size_columns(3);
            float _e807 = read_columns((((((((_e787 + 1) * _e791) + (_e793 + 1)) * _e798) + _e800) * _e803) + 1));
            scaled_1 = ((((_e723 * _e740) + (_e742 * _e761)) + (_e764 * _e783)) + (_e786 * _e807));
            int _e811 = c_7;
            float _e813 = distance_1_4;
            float _e814 = scaled_1;
            float _e816 = scale_1;
            march_line_1_there[_e811] = ((_e813 * _e814) / _e816);
        }
    }
    bool loop_init_29 = true;
    while(true) {
        if (!loop_init_29) {
            int _e1005 = c_7;
            c_7 = (_e1005 + 1);
        }
        loop_init_29 = false;
        int _e821 = c_7;
        if ((_e821 < _e75)) {
        } else {
            break;
        }
        {
            float _e823 = w00_2;
            int _e824 = row_5;
            int _e826 = size_columns(1);
            int _e828 = place_2;
            int _e831 = size_columns(2);
            int _e833 = c_7;
            int _e836 = size_columns(3);
            float _e840 = read_columns(((((((_e824 * _e826) + _e828) * _e831) + _e833) * _e836) + 0));
            float _e842 = w01_2;
            int _e843 = row_5;
            int _e845 = size_columns(1);
            int _e847 = place_2;
            int _e852 = size_columns(2);
            int _e854 = c_7;
            int _e857 = size_columns(3);
            float _e861 = read_columns(((((((_e843 * _e845) + (_e847 + 1)) * _e852) + _e854) * _e857) + 0));
            float _e864 = w10_2;
            int _e865 = row_5;
            int _e869 = size_columns(1);
            int _e871 = place_2;
            int _e874 = size_columns(2);
            int _e876 = c_7;
            int _e879 = size_columns(3);
            float _e883 = read_columns((((((((_e865 + 1) * _e869) + _e871) * _e874) + _e876) * _e879) + 0));
            float _e886 = w11_2;
            int _e887 = row_5;
            int _e891 = size_columns(1);
            int _e893 = place_2;
            int _e898 = size_columns(2);
            int _e900 = c_7;
            int _e903 = size_columns(3);
            float _e907 = read_columns((((((((_e887 + 1) * _e891) + (_e893 + 1)) * _e898) + _e900) * _e903) + 0));
            scale_1 = ((((_e823 * _e840) + (_e842 * _e861)) + (_e864 * _e883)) + (_e886 * _e907));
            float _e910 = w00_2;
            int _e911 = row_5;
            int _e913 = size_columns(1);
            int _e915 = place_2;
            int _e918 = size_columns(2);
            int _e920 = c_7;
            int _e923 = size_columns(3);
            float _e927 = read_columns(((((((_e911 * _e913) + _e915) * _e918) + _e920) * _e923) + 1));
            float _e929 = w01_2;
            int _e930 = row_5;
            int _e932 = size_columns(1);
            int _e934 = place_2;
            int _e939 = size_columns(2);
            int _e941 = c_7;
            int _e944 = size_columns(3);
            float _e948 = read_columns(((((((_e930 * _e932) + (_e934 + 1)) * _e939) + _e941) * _e944) + 1));
            float _e951 = w10_2;
            int _e952 = row_5;
            int _e956 = size_columns(1);
            int _e958 = place_2;
            int _e961 = size_columns(2);
            int _e963 = c_7;
            int _e966 = size_columns(3);
            float _e970 = read_columns((((((((_e952 + 1) * _e956) + _e958) * _e961) + _e963) * _e966) + 1));
            float _e973 = w11_2;
            int _e974 = row_5;
            int _e978 = size_columns(1);
            int _e980 = place_2;
            int _e985 = size_columns(2);
            int _e987 = c_7;
            int _e990 = size_columns(3);
            float _e994 = read_columns((((((((_e974 + 1) * _e978) + (_e980 + 1)) * _e985) + _e987) * _e990) + 1));
            scaled_1 = ((((_e910 * _e927) + (_e929 * _e948)) + (_e951 * _e970)) + (_e973 * _e994));
            int _e998 = c_7;
            float _e1000 = distance_1_4;
            float _e1001 = scaled_1;
            float _e1003 = scale_1;
            march_line_1_there[_e998] = ((_e1000 * _e1001) / _e1003);
        }
    }
    return;
}

vec4 through_columns_3_(int constituents_1) {
    vec4 tau_1 = vec4(0.0);
    int c_8 = 0;
    tau_1 = vec4(0.0);
    c_8 = 0;
    bool loop_init_30 = true;
    while(true) {
        if (!loop_init_30) {
            int _e71 = c_8;
            c_8 = (_e71 + 1);
        }
        loop_init_30 = false;
        int _e6 = c_8;
        if (((_e6 + 3) < constituents_1)) {
        } else {
            break;
        }
        {
            vec4 _e10 = tau_1;
            int _e11 = c_8;
            vec4 _e16 = read_extinction(((1 * _e11) + 0));
            int _e18 = c_8;
            float _e20 = march_line_1_here[_e18];
            tau_1 = (_e10 + (_e16 * _e20));
            int _e23 = c_8;
            c_8 = (_e23 + 1);
            vec4 _e26 = tau_1;
            int _e27 = c_8;
            vec4 _e32 = read_extinction(((1 * _e27) + 0));
            int _e34 = c_8;
            float _e36 = march_line_1_here[_e34];
            tau_1 = (_e26 + (_e32 * _e36));
            int _e39 = c_8;
            c_8 = (_e39 + 1);
            vec4 _e42 = tau_1;
            int _e43 = c_8;
            vec4 _e48 = read_extinction(((1 * _e43) + 0));
            int _e50 = c_8;
            float _e52 = march_line_1_here[_e50];
            tau_1 = (_e42 + (_e48 * _e52));
            int _e55 = c_8;
            c_8 = (_e55 + 1);
            vec4 _e58 = tau_1;
            int _e59 = c_8;
            vec4 _e64 = read_extinction(((1 * _e59) + 0));
            int _e66 = c_8;
            float _e68 = march_line_1_here[_e66];
            tau_1 = (_e58 + (_e64 * _e68));
        }
    }
    bool loop_init_31 = true;
    while(true) {
        if (!loop_init_31) {
            int _e89 = c_8;
            c_8 = (_e89 + 1);
        }
        loop_init_31 = false;
        int _e74 = c_8;
        if ((_e74 < constituents_1)) {
        } else {
            break;
        }
        {
            vec4 _e76 = tau_1;
            int _e77 = c_8;
            vec4 _e82 = read_extinction(((1 * _e77) + 0));
            int _e84 = c_8;
            float _e86 = march_line_1_here[_e84];
            tau_1 = (_e76 + (_e82 * _e86));
        }
    }
    vec4 _e92 = tau_1;
    return exp((vec4(0.0) - _e92));
}

vec4 through_columns_4_(int constituents_2) {
    vec4 tau_2 = vec4(0.0);
    int c_9 = 0;
    tau_2 = vec4(0.0);
    c_9 = 0;
    bool loop_init_32 = true;
    while(true) {
        if (!loop_init_32) {
            int _e71 = c_9;
            c_9 = (_e71 + 1);
        }
        loop_init_32 = false;
        int _e6 = c_9;
        if (((_e6 + 3) < constituents_2)) {
        } else {
            break;
        }
        {
            vec4 _e10 = tau_2;
            int _e11 = c_9;
            vec4 _e16 = read_extinction(((1 * _e11) + 0));
            int _e18 = c_9;
            float _e20 = march_line_1_there[_e18];
            tau_2 = (_e10 + (_e16 * _e20));
            int _e23 = c_9;
            c_9 = (_e23 + 1);
            vec4 _e26 = tau_2;
            int _e27 = c_9;
            vec4 _e32 = read_extinction(((1 * _e27) + 0));
            int _e34 = c_9;
            float _e36 = march_line_1_there[_e34];
            tau_2 = (_e26 + (_e32 * _e36));
            int _e39 = c_9;
            c_9 = (_e39 + 1);
            vec4 _e42 = tau_2;
            int _e43 = c_9;
            vec4 _e48 = read_extinction(((1 * _e43) + 0));
            int _e50 = c_9;
            float _e52 = march_line_1_there[_e50];
            tau_2 = (_e42 + (_e48 * _e52));
            int _e55 = c_9;
            c_9 = (_e55 + 1);
            vec4 _e58 = tau_2;
            int _e59 = c_9;
            vec4 _e64 = read_extinction(((1 * _e59) + 0));
            int _e66 = c_9;
            float _e68 = march_line_1_there[_e66];
            tau_2 = (_e58 + (_e64 * _e68));
        }
    }
    bool loop_init_33 = true;
    while(true) {
        if (!loop_init_33) {
            int _e89 = c_9;
            c_9 = (_e89 + 1);
        }
        loop_init_33 = false;
        int _e74 = c_9;
        if ((_e74 < constituents_2)) {
        } else {
            break;
        }
        {
            vec4 _e76 = tau_2;
            int _e77 = c_9;
            vec4 _e82 = read_extinction(((1 * _e77) + 0));
            int _e84 = c_9;
            float _e86 = march_line_1_there[_e84];
            tau_2 = (_e76 + (_e82 * _e86));
        }
    }
    vec4 _e92 = tau_2;
    return exp((vec4(0.0) - _e92));
}

vec4 star_at_1_(float seen_1, bool spread, int constituents_3) {
    vec4 light = vec4(0.0);
    vec4 _e4 = through_columns_3_(constituents_3);
    light = _e4;
    if (spread) {
        vec4 _e5 = light;
        vec4 _e6 = through_columns_4_(constituents_3);
        light = (_e5 + _e6);
        vec4 _e8 = light;
        light = (_e8 * 0.5);
    }
    vec4 _e11 = light;
    return (_e11 * seen_1);
}

vec4 through_columns_2_(int constituents_4) {
    vec4 tau_3 = vec4(0.0);
    int c_10 = 0;
    tau_3 = vec4(0.0);
    c_10 = 0;
    bool loop_init_34 = true;
    while(true) {
        if (!loop_init_34) {
            int _e71 = c_10;
            c_10 = (_e71 + 1);
        }
        loop_init_34 = false;
        int _e6 = c_10;
        if (((_e6 + 3) < constituents_4)) {
        } else {
            break;
        }
        {
            vec4 _e10 = tau_3;
            int _e11 = c_10;
            vec4 _e16 = read_extinction(((1 * _e11) + 0));
            int _e18 = c_10;
            float _e20 = march_line_1_before[_e18];
            tau_3 = (_e10 + (_e16 * _e20));
            int _e23 = c_10;
            c_10 = (_e23 + 1);
            vec4 _e26 = tau_3;
            int _e27 = c_10;
            vec4 _e32 = read_extinction(((1 * _e27) + 0));
            int _e34 = c_10;
            float _e36 = march_line_1_before[_e34];
            tau_3 = (_e26 + (_e32 * _e36));
            int _e39 = c_10;
            c_10 = (_e39 + 1);
            vec4 _e42 = tau_3;
            int _e43 = c_10;
            vec4 _e48 = read_extinction(((1 * _e43) + 0));
            int _e50 = c_10;
            float _e52 = march_line_1_before[_e50];
            tau_3 = (_e42 + (_e48 * _e52));
            int _e55 = c_10;
            c_10 = (_e55 + 1);
            vec4 _e58 = tau_3;
            int _e59 = c_10;
            vec4 _e64 = read_extinction(((1 * _e59) + 0));
            int _e66 = c_10;
            float _e68 = march_line_1_before[_e66];
            tau_3 = (_e58 + (_e64 * _e68));
        }
    }
    bool loop_init_35 = true;
    while(true) {
        if (!loop_init_35) {
            int _e89 = c_10;
            c_10 = (_e89 + 1);
        }
        loop_init_35 = false;
        int _e74 = c_10;
        if ((_e74 < constituents_4)) {
        } else {
            break;
        }
        {
            vec4 _e76 = tau_3;
            int _e77 = c_10;
            vec4 _e82 = read_extinction(((1 * _e77) + 0));
            int _e84 = c_10;
            float _e86 = march_line_1_before[_e84];
            tau_3 = (_e76 + (_e82 * _e86));
        }
    }
    vec4 _e92 = tau_3;
    return exp((vec4(0.0) - _e92));
}

void march_line_1_(float r_17, float mu_16, float mu_s_5, float nu_2, float length_1_4, int orders) {
    float bottom_4 = 0.0;
    float top_4 = 0.0;
    float first_cut_1 = 0.0;
    float second_cut_1 = 0.0;
    int count_4 = 0;
    float end_4 = 0.0;
    float slant = 0.0;
    bool day = false;
    int kind = 0;
    int rule_4 = 0;
    int n_4 = 0;
    int attempt = 0;
    int which_1 = 0;
    float scatters = 0.0;
    int c_11 = 0;
    float faint = 0.0;
    vec4 air = vec4(0.0);
    vec4 first_5 = vec4(0.0);
    vec4 second_1 = vec4(0.0);
    int block = 0;
    int panel_1 = 0;
    int k_5 = 0;
    float q = 0.0;
    float t = 0.0;
    float mu_q = 0.0;
    float mu_sq = 0.0;
    float nu_q = 0.0;
    float depth_2 = 0.0;
    float angle_2 = 0.0;
    vec4 through = vec4(0.0);
    float seen_2 = 0.0;
    float low_6 = 0.0;
    float high_3 = 0.0;
    vec4 star = vec4(0.0);
    bool local_11 = false;
    bool local_12 = false;
    bool local_13 = false;
    float now_1_3 = _group_0_binding_0_fs.shell.x;
    float now_2_3 = _group_0_binding_0_fs.shell.y;
    bottom_4 = now_1_3;
    top_4 = now_2_3;
    float _e48 = bottom_4;
    Several_f32_f32_ _e49 = shadow_edges(r_17, mu_16, mu_s_5, nu_2, _e48);
    first_cut_1 = _e49.v0_;
    second_cut_1 = _e49.v1_;
    float _e52 = first_cut_1;
    float _e53 = second_cut_1;
    int _e54 = place_edges_1_(r_17, mu_16, length_1_4, _e52, _e53);
    count_4 = _e54;
    float _e55 = bottom_4;
    int _e56 = count_4;
    int _e57 = cut_at_corners_1_(r_17, mu_16, _e55, _e56);
    count_4 = _e57;
    float _e61 = radius_along(r_17, mu_16, length_1_4);
    end_4 = min(mu_s_5, (((r_17 * mu_s_5) + (length_1_4 * nu_2)) / _e61));
    float _e64 = top_4;
    float _e65 = bottom_4;
    slant = (length_1_4 / (_e64 - _e65));
    float _e68 = end_4;
    day = (_e68 > 0.1);
    float _e71 = slant;
    if (!((_e71 < 9.0))) {
        int _e77 = count_4;
        local_11 = (_e77 > 6);
    } else {
        local_11 = true;
    }
    bool _e81 = local_11;
    kind = (_e81 ? 1 : 2);
    bool _e85 = day;
    if (_e85) {
        float _e88 = slant;
        local_12 = (_e88 < 4.0);
    } else {
        local_12 = false;
    }
    bool _e92 = local_12;
    if (!(_e92)) {
        int _e96 = count_4;
        local_13 = (_e96 > 10);
    } else {
        local_13 = true;
    }
    bool _e100 = local_13;
    if (_e100) {
        kind = 0;
    }
    int _e102 = kind;
    float _e103 = read_rules(_e102);
    rule_4 = int(_e103);
    int _e105 = rule_4;
    float _e106 = read_rules(_e105);
    n_4 = int(_e106);
    attempt = 0;
    bool loop_init_36 = true;
    while(true) {
        if (!loop_init_36) {
            int _e130 = attempt;
            attempt = (_e130 + 1);
        }
        loop_init_36 = false;
        int _e109 = attempt;
        if ((_e109 < 2)) {
        } else {
            break;
        }
        {
            int _e112 = count_4;
            int _e113 = rule_4;
            float _e114 = columns_along_1_(r_17, mu_16, _e112, _e113);
            if ((_e114 <= 15.0)) {
                break;
            }
            which_1 = 0;
            bool loop_init_37 = true;
            while(true) {
                if (!loop_init_37) {
                    int _e127 = which_1;
                    which_1 = (_e127 + 1);
                }
                loop_init_37 = false;
                int _e118 = which_1;
                if ((_e118 < 3)) {
                } else {
                    break;
                }
                {
                    int _e121 = count_4;
                    int _e123 = which_1;
                    float _e125 = march_line_1_cuts[_e123];
                    int _e126 = insert_edge_1_(_e121, _e125);
                    count_4 = _e126;
                }
            }
        }
    }
    scatters = 0.0;
    float _e137 = _group_0_binding_0_fs.counts.x;
    int end_4_3 = int(_e137);
    c_11 = 0;
    bool loop_init_38 = true;
    while(true) {
        if (!loop_init_38) {
            int _e205 = c_11;
            c_11 = (_e205 + 1);
        }
        loop_init_38 = false;
        int _e140 = c_11;
        if (((_e140 + 3) < end_4_3)) {
        } else {
            break;
        }
        {
            float _e144 = scatters;
            int _e145 = c_11;
            float _e146 = read_brightest(_e145);
            int _e148 = c_11;
            float _e150 = look_1_totals[_e148];
            scatters = (_e144 + (_e146 * _e150));
            int _e154 = c_11;
            march_line_1_before[_e154] = 0.0;
            int _e157 = c_11;
            c_11 = (_e157 + 1);
            float _e160 = scatters;
            int _e161 = c_11;
            float _e162 = read_brightest(_e161);
            int _e164 = c_11;
            float _e166 = look_1_totals[_e164];
            scatters = (_e160 + (_e162 * _e166));
            int _e170 = c_11;
            march_line_1_before[_e170] = 0.0;
            int _e173 = c_11;
            c_11 = (_e173 + 1);
            float _e176 = scatters;
            int _e177 = c_11;
            float _e178 = read_brightest(_e177);
            int _e180 = c_11;
            float _e182 = look_1_totals[_e180];
            scatters = (_e176 + (_e178 * _e182));
            int _e186 = c_11;
            march_line_1_before[_e186] = 0.0;
            int _e189 = c_11;
            c_11 = (_e189 + 1);
            float _e192 = scatters;
            int _e193 = c_11;
            float _e194 = read_brightest(_e193);
            int _e196 = c_11;
            float _e198 = look_1_totals[_e196];
            scatters = (_e192 + (_e194 * _e198));
            int _e202 = c_11;
            march_line_1_before[_e202] = 0.0;
        }
    }
    bool loop_init_39 = true;
    while(true) {
        if (!loop_init_39) {
            int _e223 = c_11;
            c_11 = (_e223 + 1);
        }
        loop_init_39 = false;
        int _e208 = c_11;
        if ((_e208 < end_4_3)) {
        } else {
            break;
        }
        {
            float _e210 = scatters;
            int _e211 = c_11;
            float _e212 = read_brightest(_e211);
            int _e214 = c_11;
            float _e216 = look_1_totals[_e214];
            scatters = (_e210 + (_e212 * _e216));
            int _e220 = c_11;
            march_line_1_before[_e220] = 0.0;
        }
    }
    float _e226 = scatters;
    bool _e231 = day;
    faint = (_e231 ? (0.0005 * min(_e226, 1.0)) : 0.0);
    vec4 now_5_ = vec4(0.0);
    vec4 now_6_1 = vec4(0.0);
    vec4 now_7_1 = vec4(0.0);
    air = now_5_;
    first_5 = now_6_1;
    second_1 = now_7_1;
    float _e243 = _group_0_binding_0_fs.counts.y;
    float _e250 = _group_0_binding_0_fs.counts.y;
    int _e256 = whole_quotient(((int(_e243) + 1) * (int(_e250) + 2)), 2);
    block = (1 * (1 + _e256));
    panel_1 = 0;
    bool loop_init_40 = true;
    while(true) {
        if (!loop_init_40) {
            int _e779 = panel_1;
            panel_1 = (_e779 + 1);
        }
        loop_init_40 = false;
        int _e262 = panel_1;
        int _e263 = count_4;
        if ((_e262 < (_e263 - 1))) {
        } else {
            break;
        }
        {
            int _e268 = panel_1;
            float _e270 = march_line_1_edges[_e268];
            int _e272 = panel_1;
            float _e276 = march_line_1_edges[(_e272 + 1)];
            int _e278 = count_4;
            float _e282 = march_line_1_edges[(_e278 - 1)];
            int _e283 = rule_4;
            place_panel_1_(r_17, mu_16, _e270, _e276, _e282, _e283);
            c_11 = 0;
            bool loop_init_41 = true;
            while(true) {
                if (!loop_init_41) {
                    int _e415 = c_11;
                    c_11 = (_e415 + 1);
                }
                loop_init_41 = false;
                int _e285 = c_11;
                float _e289 = _group_0_binding_0_fs.counts.x;
                if ((_e285 < int(_e289))) {
                } else {
                    break;
                }
                {
                    int end_8_ = n_4;
                    k_5 = 0;
                    bool loop_init_42 = true;
                    while(true) {
                        if (!loop_init_42) {
                            int _e387 = k_5;
                            k_5 = (_e387 + 1);
                        }
                        loop_init_42 = false;
                        int _e294 = k_5;
                        if (((_e294 + 3) < end_8_)) {
                        } else {
                            break;
                        }
                        {
                            int _e299 = c_11;
                            int _e302 = k_5;
                            int _e306 = c_11;
                            int _e309 = k_5;
                            float _e312 = march_line_1_density[((_e306 * 24) + _e309)];
                            int _e314 = k_5;
                            float _e316 = march_line_1_weight[_e314];
                            march_line_1_amounts[((_e299 * 24) + _e302)] = (_e312 * _e316);
                            int _e318 = k_5;
                            k_5 = (_e318 + 1);
                            int _e322 = c_11;
                            int _e325 = k_5;
                            int _e329 = c_11;
                            int _e332 = k_5;
                            float _e335 = march_line_1_density[((_e329 * 24) + _e332)];
                            int _e337 = k_5;
                            float _e339 = march_line_1_weight[_e337];
                            march_line_1_amounts[((_e322 * 24) + _e325)] = (_e335 * _e339);
                            int _e341 = k_5;
                            k_5 = (_e341 + 1);
                            int _e345 = c_11;
                            int _e348 = k_5;
                            int _e352 = c_11;
                            int _e355 = k_5;
                            float _e358 = march_line_1_density[((_e352 * 24) + _e355)];
                            int _e360 = k_5;
                            float _e362 = march_line_1_weight[_e360];
                            march_line_1_amounts[((_e345 * 24) + _e348)] = (_e358 * _e362);
                            int _e364 = k_5;
                            k_5 = (_e364 + 1);
                            int _e368 = c_11;
                            int _e371 = k_5;
                            int _e375 = c_11;
                            int _e378 = k_5;
                            float _e381 = march_line_1_density[((_e375 * 24) + _e378)];
                            int _e383 = k_5;
                            float _e385 = march_line_1_weight[_e383];
                            march_line_1_amounts[((_e368 * 24) + _e371)] = (_e381 * _e385);
                        }
                    }
                    bool loop_init_43 = true;
                    while(true) {
                        if (!loop_init_43) {
                            int _e412 = k_5;
                            k_5 = (_e412 + 1);
                        }
                        loop_init_43 = false;
                        int _e390 = k_5;
                        if ((_e390 < end_8_)) {
                        } else {
                            break;
                        }
                        {
                            int _e393 = c_11;
                            int _e396 = k_5;
                            int _e400 = c_11;
                            int _e403 = k_5;
                            float _e406 = march_line_1_density[((_e400 * 24) + _e403)];
                            int _e408 = k_5;
                            float _e410 = march_line_1_weight[_e408];
                            march_line_1_amounts[((_e393 * 24) + _e396)] = (_e406 * _e410);
                        }
                    }
                }
            }
            int _e418 = rule_4;
            panel_columns_1_(_e418);
            k_5 = 0;
            bool loop_init_44 = true;
            while(true) {
                if (!loop_init_44) {
                    int _e776 = k_5;
                    k_5 = (_e776 + 1);
                }
                loop_init_44 = false;
                int _e420 = k_5;
                int _e421 = n_4;
                if ((_e420 < _e421)) {
                } else {
                    break;
                }
                {
                    int _e424 = k_5;
                    float _e426 = march_line_1_radius[_e424];
                    float _e427 = bottom_4;
                    float _e429 = top_4;
                    q = min(max(_e426, _e427), _e429);
                    int _e432 = k_5;
                    float _e434 = march_line_1_distance_1_[_e432];
                    t = _e434;
                    float _e436 = t;
                    float _e438 = q;
                    mu_q = min(max((((r_17 * mu_16) + _e436) / _e438), -1.0), 1.0);
                    float _e445 = t;
                    float _e448 = q;
                    mu_sq = min(max((((r_17 * mu_s_5) + (_e445 * nu_2)) / _e448), -1.0), 1.0);
                    nu_q = nu_2;
                    depth_2 = 0.0;
                    float _e458 = _group_0_binding_0_fs.counts.x;
                    int end_9_ = int(_e458);
                    c_11 = 0;
                    bool loop_init_45 = true;
                    while(true) {
                        if (!loop_init_45) {
                            int _e598 = c_11;
                            c_11 = (_e598 + 1);
                        }
                        loop_init_45 = false;
                        int _e461 = c_11;
                        if (((_e461 + 3) < end_9_)) {
                        } else {
                            break;
                        }
                        {
                            int _e466 = c_11;
                            int _e469 = c_11;
                            int _e472 = k_5;
                            float _e475 = march_line_1_density[((_e469 * 24) + _e472)];
                            march_line_1_rho[_e466] = _e475;
                            int _e477 = c_11;
                            int _e480 = c_11;
                            int _e483 = k_5;
                            float _e486 = march_line_1_columns[((_e480 * 24) + _e483)];
                            march_line_1_depths[_e477] = _e486;
                            float _e487 = depth_2;
                            int _e488 = c_11;
                            float _e489 = read_brightest(_e488);
                            int _e491 = c_11;
                            float _e493 = march_line_1_rho[_e491];
                            depth_2 = (_e487 + (_e489 * _e493));
                            int _e496 = c_11;
                            c_11 = (_e496 + 1);
                            int _e500 = c_11;
                            int _e503 = c_11;
                            int _e506 = k_5;
                            float _e509 = march_line_1_density[((_e503 * 24) + _e506)];
                            march_line_1_rho[_e500] = _e509;
                            int _e511 = c_11;
                            int _e514 = c_11;
                            int _e517 = k_5;
                            float _e520 = march_line_1_columns[((_e514 * 24) + _e517)];
                            march_line_1_depths[_e511] = _e520;
                            float _e521 = depth_2;
                            int _e522 = c_11;
                            float _e523 = read_brightest(_e522);
                            int _e525 = c_11;
                            float _e527 = march_line_1_rho[_e525];
                            depth_2 = (_e521 + (_e523 * _e527));
                            int _e530 = c_11;
                            c_11 = (_e530 + 1);
                            int _e534 = c_11;
                            int _e537 = c_11;
                            int _e540 = k_5;
                            float _e543 = march_line_1_density[((_e537 * 24) + _e540)];
                            march_line_1_rho[_e534] = _e543;
                            int _e545 = c_11;
                            int _e548 = c_11;
                            int _e551 = k_5;
                            float _e554 = march_line_1_columns[((_e548 * 24) + _e551)];
                            march_line_1_depths[_e545] = _e554;
                            float _e555 = depth_2;
                            int _e556 = c_11;
                            float _e557 = read_brightest(_e556);
                            int _e559 = c_11;
                            float _e561 = march_line_1_rho[_e559];
                            depth_2 = (_e555 + (_e557 * _e561));
                            int _e564 = c_11;
                            c_11 = (_e564 + 1);
                            int _e568 = c_11;
                            int _e571 = c_11;
                            int _e574 = k_5;
                            float _e577 = march_line_1_density[((_e571 * 24) + _e574)];
                            march_line_1_rho[_e568] = _e577;
                            int _e579 = c_11;
                            int _e582 = c_11;
                            int _e585 = k_5;
                            float _e588 = march_line_1_columns[((_e582 * 24) + _e585)];
                            march_line_1_depths[_e579] = _e588;
                            float _e589 = depth_2;
                            int _e590 = c_11;
                            float _e591 = read_brightest(_e590);
                            int _e593 = c_11;
                            float _e595 = march_line_1_rho[_e593];
                            depth_2 = (_e589 + (_e591 * _e595));
                        }
                    }
                    bool loop_init_46 = true;
                    while(true) {
                        if (!loop_init_46) {
                            int _e634 = c_11;
                            c_11 = (_e634 + 1);
                        }
                        loop_init_46 = false;
                        int _e601 = c_11;
                        if ((_e601 < end_9_)) {
                        } else {
                            break;
                        }
                        {
                            int _e604 = c_11;
                            int _e607 = c_11;
                            int _e610 = k_5;
                            float _e613 = march_line_1_density[((_e607 * 24) + _e610)];
                            march_line_1_rho[_e604] = _e613;
                            int _e615 = c_11;
                            int _e618 = c_11;
                            int _e621 = k_5;
                            float _e624 = march_line_1_columns[((_e618 * 24) + _e621)];
                            march_line_1_depths[_e615] = _e624;
                            float _e625 = depth_2;
                            int _e626 = c_11;
                            float _e627 = read_brightest(_e626);
                            int _e629 = c_11;
                            float _e631 = march_line_1_rho[_e629];
                            depth_2 = (_e625 + (_e627 * _e631));
                        }
                    }
                    float _e640 = _group_0_binding_0_fs.shell.w;
                    if ((_e640 > 0.0)) {
                        float _e646 = _group_0_binding_0_fs.shell.w;
                        float _e651 = _group_0_binding_0_fs.counts.x;
                        float _e656 = march_line_1_depths[(int(_e651) - 1)];
                        float _e657 = bend_angle(r_17, mu_16, _e646, _e656);
                        angle_2 = _e657;
                        float _e658 = mu_q;
                        float _e659 = mu_sq;
                        float _e660 = angle_2;
                        Several_f32_f32_ _e661 = turned(_e658, _e659, nu_2, _e660);
                        mu_sq = _e661.v0_;
                        nu_q = _e661.v1_;
                        float _e664 = mu_sq;
                        mu_sq = min(max(_e664, -1.0), 1.0);
                    }
                    float _e672 = _group_0_binding_0_fs.counts.x;
                    vec4 _e674 = through_columns_1_(int(_e672));
                    int _e676 = k_5;
                    float _e678 = march_line_1_weight[_e676];
                    through = (_e674 * _e678);
                    if ((orders != 0)) {
                        float _e682 = q;
                        float _e683 = mu_sq;
                        float _e684 = bottom_4;
                        float _e685 = top_4;
                        float _e689 = _group_0_binding_0_fs.shell.z;
                        Several_f32_f32_f32_ _e690 = star_points(_e682, _e683, _e684, _e685, _e689);
                        seen_2 = _e690.v0_;
                        low_6 = _e690.v1_;
                        high_3 = _e690.v2_;
                        float _e694 = seen_2;
                        if ((_e694 > 0.0)) {
                            float _e697 = q;
                            float _e698 = low_6;
                            float _e699 = bottom_4;
                            float _e700 = top_4;
                            columns_to_top_1_(_e697, _e698, _e699, _e700);
                            float _e701 = high_3;
                            float _e702 = low_6;
                            if ((_e701 > _e702)) {
                                float _e704 = q;
                                float _e705 = high_3;
                                float _e706 = bottom_4;
                                float _e707 = top_4;
                                columns_to_top_2_(_e704, _e705, _e706, _e707);
                            }
                            vec4 _e708 = through;
                            float _e709 = seen_2;
                            float _e710 = high_3;
                            float _e711 = low_6;
                            float _e716 = _group_0_binding_0_fs.counts.x;
                            vec4 _e718 = star_at_1_(_e709, (_e710 > _e711), int(_e716));
                            star = (_e708 * _e718);
                            float _e723 = _group_0_binding_0_fs.peaks.y;
                            if ((int(_e723) >= 0)) {
                                vec4 _e727 = first_5;
                                vec4 _e728 = star;
                                float _e732 = _group_0_binding_0_fs.peaks.y;
                                vec4 _e736 = read_scattering((1 * int(_e732)));
                                float _e742 = _group_0_binding_0_fs.peaks.y;
                                float _e745 = march_line_1_rho[int(_e742)];
                                first_5 = (_e727 + ((_e728 * _e736) * _e745));
                            }
                            float _e751 = _group_0_binding_0_fs.peaks.z;
                            if ((int(_e751) >= 0)) {
                                vec4 _e755 = second_1;
                                vec4 _e756 = star;
                                float _e760 = _group_0_binding_0_fs.peaks.z;
                                vec4 _e764 = read_scattering((1 * int(_e760)));
                                float _e770 = _group_0_binding_0_fs.peaks.z;
                                float _e773 = march_line_1_rho[int(_e770)];
                                second_1 = (_e755 + ((_e756 * _e764) * _e773));
                            }
                        }
                    }
                }
            }
        }
    }
    float _e785 = _group_0_binding_0_fs.counts.x;
    int end_12_ = int(_e785);
    c_11 = 0;
    bool loop_init_47 = true;
    while(true) {
        if (!loop_init_47) {
            int _e829 = c_11;
            c_11 = (_e829 + 1);
        }
        loop_init_47 = false;
        int _e788 = c_11;
        if (((_e788 + 3) < end_12_)) {
        } else {
            break;
        }
        {
            int _e793 = c_11;
            int _e796 = c_11;
            float _e798 = march_line_1_before[_e796];
            look_1_totals[_e793] = _e798;
            int _e799 = c_11;
            c_11 = (_e799 + 1);
            int _e803 = c_11;
            int _e806 = c_11;
            float _e808 = march_line_1_before[_e806];
            look_1_totals[_e803] = _e808;
            int _e809 = c_11;
            c_11 = (_e809 + 1);
            int _e813 = c_11;
            int _e816 = c_11;
            float _e818 = march_line_1_before[_e816];
            look_1_totals[_e813] = _e818;
            int _e819 = c_11;
            c_11 = (_e819 + 1);
            int _e823 = c_11;
            int _e826 = c_11;
            float _e828 = march_line_1_before[_e826];
            look_1_totals[_e823] = _e828;
        }
    }
    bool loop_init_48 = true;
    while(true) {
        if (!loop_init_48) {
            int _e841 = c_11;
            c_11 = (_e841 + 1);
        }
        loop_init_48 = false;
        int _e832 = c_11;
        if ((_e832 < end_12_)) {
        } else {
            break;
        }
        {
            int _e835 = c_11;
            int _e838 = c_11;
            float _e840 = march_line_1_before[_e838];
            look_1_totals[_e835] = _e840;
        }
    }
    vec4 _e846 = air;
    look_1_along[0] = _e846;
    float _e852 = _group_0_binding_0_fs.counts.x;
    vec4 _e854 = through_columns_2_(int(_e852));
    look_1_along[1] = _e854;
    vec4 _e857 = first_5;
    look_1_along[2] = _e857;
    vec4 _e860 = second_1;
    look_1_along[3] = _e860;
    return;
}

float look_1_(float mu_17, float sine_1_4, float cos_azimuth_1, bool to_ground) {
    float nu_3 = 0.0;
    float r_18 = 0.0;
    float start_mu = 0.0;
    float start_mu_s = 0.0;
    float impact_1 = 0.0;
    float across_3 = 0.0;
    float up_1 = 0.0;
    float length_1_5 = 0.0;
    vec4 ground = vec4(0.0);
    float angle_3 = 0.0;
    float _e18 = _group_0_binding_0_fs.star.x;
    float _e23 = _group_0_binding_0_fs.star.y;
    nu_3 = min(max((((sine_1_4 * cos_azimuth_1) * _e18) + (mu_17 * _e23)), -1.0), 1.0);
    float now_1_4 = _group_0_binding_0_fs.observer.x;
    float now_3_3 = _group_0_binding_0_fs.star.y;
    r_18 = now_1_4;
    start_mu = mu_17;
    start_mu_s = now_3_3;
    float _e41 = _group_0_binding_0_fs.observer.x;
    impact_1 = (_e41 * sine_1_4);
    float _e46 = _group_0_binding_0_fs.observer.y;
    if ((_e46 > 0.5)) {
        float _e52 = _group_0_binding_0_fs.shell.y;
        r_18 = _e52;
        float _e53 = impact_1;
        float _e57 = _group_0_binding_0_fs.shell.y;
        float _e62 = _group_0_binding_0_fs.shell.y;
        Several_f32_f32_ _e63 = first_meeting(min(_e53, _e57), sine_1_4, _e62);
        across_3 = _e63.v0_;
        up_1 = _e63.v1_;
        float _e69 = _group_0_binding_0_fs.shell.y;
        float _e70 = impact_1;
        float _e75 = _group_0_binding_0_fs.shell.y;
        float _e76 = impact_1;
        float _e86 = _group_0_binding_0_fs.shell.y;
        start_mu = (-(sqrt(max(((_e69 - _e70) * (_e75 + _e76)), 0.0))) / _e86);
        float _e88 = across_3;
        float _e89 = up_1;
        float _e93 = _group_0_binding_0_fs.shell.y;
        float _e97 = _group_0_binding_0_fs.star.x;
        float _e101 = _group_0_binding_0_fs.star.y;
        float _e102 = star_from(_e88, _e89, _e93, cos_azimuth_1, _e97, _e101);
        start_mu_s = _e102;
    }
    float _e103 = r_18;
    float _e104 = start_mu;
    float _e108 = _group_0_binding_0_fs.shell.y;
    float _e109 = distance_to_top(_e103, _e104, _e108);
    length_1_5 = _e109;
    if (to_ground) {
        float _e110 = r_18;
        float _e111 = start_mu;
        float _e115 = _group_0_binding_0_fs.shell.x;
        float _e116 = distance_to_bottom(_e110, _e111, _e115);
        length_1_5 = _e116;
    }
    float _e117 = r_18;
    float _e118 = start_mu;
    float _e119 = start_mu_s;
    float _e120 = nu_3;
    float _e121 = length_1_5;
    float _e125 = _group_0_binding_0_fs.peaks.w;
    march_line_1_(_e117, _e118, _e119, _e120, _e121, int(_e125));
    ground = vec4(0.0);
    angle_3 = 0.0;
    vec4 _e134 = look_1_along[0];
    peaks_texel_1_found[0] = _e134;
    vec4 _e137 = ground;
    peaks_texel_1_found[1] = _e137;
    vec4 _e142 = look_1_along[2];
    peaks_texel_1_found[2] = _e142;
    vec4 _e147 = look_1_along[3];
    peaks_texel_1_found[3] = _e147;
    float _e148 = angle_3;
    return _e148;
}

void peaks_texel_1_(int column_2, int row_6, int columns, int rows_1) {
    bool sky_2 = false;
    float at_5 = 0.0;
    float azimuth = 0.0;
    float cos_azimuth_2 = 0.0;
    float sine_1_5 = 0.0;
    float mu_18 = 0.0;
    float side = 0.0;
    float half_sine_2 = 0.0;
    int layer = 0;
    sky_2 = (row_6 < rows_1);
    float _e17 = _group_0_binding_0_fs.observer.y;
    float _e20 = row_coordinate(row_6, rows_1, (_e17 > 0.5));
    at_5 = _e20;
    azimuth = ((3.1415927 * float(column_2)) / float((columns - 1)));
    float _e28 = azimuth;
    float _e29 = cosine(_e28);
    cos_azimuth_2 = _e29;
    float _e33 = _group_0_binding_0_fs.observer.y;
    if ((_e33 > 0.5)) {
        float _e36 = at_5;
        bool _e37 = sky_2;
        float _e41 = _group_0_binding_0_fs.shell.x;
        float _e45 = _group_0_binding_0_fs.shell.y;
        float _e46 = impact_from_row(_e36, _e37, _e41, _e45);
        float _e50 = _group_0_binding_0_fs.observer.x;
        sine_1_5 = (_e46 / _e50);
        float _e52 = sine_1_5;
        float _e55 = sine_1_5;
        mu_18 = -(sqrt(max(((1.0 - _e52) * (1.0 + _e55)), 0.0)));
    } else {
        float _e63 = at_5;
        bool _e64 = sky_2;
        float _e68 = _group_0_binding_0_fs.observer.z;
        float _e72 = _group_0_binding_0_fs.observer.w;
        Several_f32_f32_ _e73 = direction_from_row(_e63, _e64, _e68, _e72);
        mu_18 = _e73.v0_;
        sine_1_5 = _e73.v1_;
    }
    float _e76 = cos_azimuth_2;
    float _e79 = cos_azimuth_2;
    side = sqrt(max(((1.0 - _e76) * (1.0 + _e79)), 0.0));
    float _e86 = sine_1_5;
    float _e87 = cos_azimuth_2;
    float _e89 = sine_1_5;
    float _e90 = side;
    float _e92 = mu_18;
    float _e96 = _group_0_binding_0_fs.star.z;
    float _e100 = _group_0_binding_0_fs.star.w;
    float _e101 = half_sine_between((_e86 * _e87), (_e89 * _e90), _e92, _e96, _e100);
    half_sine_2 = _e101;
    float _e102 = half_sine_2;
    phases_towards_1_(_e102);
    float _e103 = mu_18;
    float _e104 = sine_1_5;
    float _e105 = cos_azimuth_2;
    bool _e106 = sky_2;
    float _e108 = look_1_(_e103, _e104, _e105, !(_e106));
    layer = 0;
    bool loop_init_49 = true;
    while(true) {
        if (!loop_init_49) {
            int _e129 = layer;
            layer = (_e129 + 1);
        }
        loop_init_49 = false;
        int _e110 = layer;
        if ((_e110 < 4)) {
        } else {
            break;
        }
        {
            int _e114 = layer;
            int _e119 = layer;
            vec4 _e123 = peaks_texel_1_found[(1 * _e119)];
            sky_peaks_found[(1 * _e114)] = sqrt(sqrt(max(_e123, vec4(0.0))));
        }
    }
    return;
}

void main() {
    vec4 at = gl_FragCoord;
    float _e4 = _group_0_binding_0_fs.sky.x;
    int columns_1 = int(_e4);
    int number = ((int(at.y) * 2048) + int(at.x));
    float _e18 = _group_0_binding_0_fs.sky.y;
    peaks_texel_1_((number % columns_1), (number / columns_1), columns_1, int(_e18));
    vec4 _e22 = sky_peaks_found[2];
    vec4 _e25 = sky_peaks_found[3];
    Layers _tmp_return = Layers(_e22, _e25);
    _fs2p_location0 = _tmp_return.first;
    _fs2p_location1 = _tmp_return.second;
    return;
}
