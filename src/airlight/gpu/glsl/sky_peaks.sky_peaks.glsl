#version 300 es
// of sky_peaks.wgsl dd932706867752b1, by naga-wasm@30.1.0
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
struct Layers {
    vec4 first;
    vec4 second;
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

float sine_of_quarter(float x_2) {
    float y_2 = (x_2 * x_2);
    return (x_2 + ((x_2 * y_2) * (-0.16666655 + (y_2 * (0.008332161 - (0.00019515296 * y_2))))));
}

float cosine_of_quarter(float x_3) {
    float y_3 = (x_3 * x_3);
    float tail = ((y_3 * y_3) * (0.041666646 + (y_3 * (-0.0013887316 + (2.4433157e-5 * y_3)))));
    return ((1.0 - (0.5 * y_3)) + tail);
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
    bool local = false;
    float turns_2 = roundEven((x_6 * 0.63661975));
    float _e4 = rest_of_quarter(x_6, turns_2);
    int quarter_1 = (int(turns_2) & 3);
    float _e8 = cosine_of_quarter(_e4);
    float _e9 = sine_of_quarter(_e4);
    float value_1 = (((quarter_1 & 1) == 1) ? _e9 : _e8);
    if (!((quarter_1 == 1))) {
        local = (quarter_1 == 2);
    } else {
        local = true;
    }
    bool _e24 = local;
    return (_e24 ? -(value_1) : value_1);
}

float impact_from_row(float row, bool sky, float bottom_radius, float top_radius) {
    if (sky) {
        return (bottom_radius + ((row * row) * (top_radius - bottom_radius)));
    }
    return (bottom_radius * (1.0 - (row * row)));
}

Several_f32_f32_ direction_from_row(float row_1, bool sky_1, float horizon_mu, float horizon_sine) {
    float highest = 0.0;
    float angle = 0.0;
    float turn = 0.0;
    float keep = 0.0;
    highest = acos(horizon_mu);
    float _e10 = highest;
    float _e13 = highest;
    angle = ((row_1 * row_1) * (sky_1 ? _e13 : (_e10 - 3.1415927)));
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

float half_sine_between(float x_7, float y, float z, float sun_x, float sun_z) {
    float across = 0.0;
    across = (((x_7 - sun_x) * (x_7 - sun_x)) + (y * y));
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
    float a = 0.0;
    float b = 0.0;
    float c = 0.0;
    float discriminant = 0.0;
    float root = 0.0;
    float first = 0.0;
    float second = 0.0;
    float plane = 0.0;
    a = ((1.0 - nu) * (1.0 + nu));
    float _e18 = a;
    if ((_e18 < 1e-12)) {
        return Several_f32_f32_(0.0, 0.0);
    }
    b = (r_3 * (mu_3 - (mu_s * nu)));
    c = ((((r_3 * r_3) * (1.0 - mu_s)) * (1.0 + mu_s)) - (bottom_radius_2 * bottom_radius_2));
    float _e36 = b;
    float _e37 = b;
    float _e39 = a;
    float _e40 = c;
    discriminant = ((_e36 * _e37) - (_e39 * _e40));
    float _e43 = discriminant;
    if ((_e43 <= 0.0)) {
        return Several_f32_f32_(0.0, 0.0);
    }
    float _e49 = discriminant;
    root = sqrt(_e49);
    float _e51 = b;
    float _e53 = root;
    float _e55 = a;
    first = ((-(_e51) - _e53) / _e55);
    float _e57 = b;
    float _e59 = root;
    float _e61 = a;
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
    float y_1 = 0.0;
    float away = 0.0;
    float radius_3 = 0.0;
    float distance_1_1 = 0.0;
    float slope = 0.0;
    y_1 = (first_2 + ((last_1 - first_2) * node));
    float _e16 = y_1;
    float _e17 = y_1;
    float _e21 = y_1;
    float _e22 = y_1;
    away = sqrt(((beside_1 * beside_1) + ((_e16 * _e17) * ((2.0 * low_1) + (_e21 * _e22)))));
    float _e28 = y_1;
    float _e29 = y_1;
    radius_3 = (low_1 + (_e28 * _e29));
    float _e32 = away;
    float _e34 = away;
    distance_1_1 = (descending_1 ? (nearest_1 - _e34) : (nearest_1 + _e32));
    float _e39 = y_1;
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
    float x_8 = 0.0;
    int node_1 = 0;
    altitude = min(max(((radius_4 - bottom_radius_3) / thickness), 0.0), 1.0);
    float _e13 = altitude;
    x_8 = (sqrt(_e13) * float((nodes - 1)));
    float _e19 = x_8;
    node_1 = min(int(_e19), (nodes - 2));
    int _e24 = node_1;
    float _e25 = x_8;
    int _e26 = node_1;
    return Several_i32_f32_(_e24, (_e25 - float(_e26)));
}

float bend_angle(float x_9, float mu_6, float bend, float column) {
    return (((bend * column) * x_9) * sqrt(max(((1.0 - mu_6) * (1.0 + mu_6)), 0.0)));
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

float sun_elevation(float r_6, float mu_s_2, float bottom_radius_4) {
    float sine_1_2 = 0.0;
    float horizon = 0.0;
    sine_1_2 = (bottom_radius_4 / r_6);
    float _e6 = sine_1_2;
    float _e9 = sine_1_2;
    horizon = -(sqrt(max(((1.0 - _e6) * (1.0 + _e9)), 0.0)));
    float _e17 = horizon;
    float _e19 = sine_1_2;
    return ((mu_s_2 - _e17) / _e19);
}

float horizon_cosine(float r_7, float bottom_radius_5) {
    return (-(sqrt(max(((r_7 - bottom_radius_5) * (r_7 + bottom_radius_5)), 0.0))) / r_7);
}

Several_f32_f32_f32_ seen_star(float x_10, float mu_s_3, float bottom, float top) {
    float sine_1_3 = 0.0;
    float horizon_1 = 0.0;
    float tangent_1 = 0.0;
    float at_1 = 0.0;
    int row_2 = 0;
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
        float _e25 = sun_elevation(x_10, mu_s_3, bottom);
        return Several_f32_f32_f32_(mu_s_3, 1.0, _e25);
    }
    sine_1_3 = (bottom / x_10);
    float _e29 = horizon_cosine(x_10, bottom);
    horizon_1 = _e29;
    tangent_1 = sqrt(((top - bottom) * (top + bottom)));
    float _e40 = tangent_1;
    int _e43 = size_lift(0);
    at_1 = ((sqrt(max(((x_10 - bottom) * (x_10 + bottom)), 0.0)) / _e40) * float((_e43 - 1)));
    float _e48 = at_1;
    int _e51 = size_lift(0);
    row_2 = min(int(_e48), (_e51 - 2));
    float _e55 = at_1;
    int _e56 = row_2;
    f = (_e55 - float(_e56));
    float _e59 = horizon_1;
    int _e60 = row_2;
    int _e62 = size_lift(1);
    int _e67 = size_lift(2);
    float _e71 = read_lift(((((_e60 * _e62) + 0) * _e67) + 0));
    float _e72 = f;
    int _e76 = row_2;
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
    int _e144 = row_2;
    int _e146 = size_lift(1);
    int _e148 = column_1;
    int _e151 = size_lift(2);
    float _e155 = read_lift(((((_e144 * _e146) + _e148) * _e151) + 0));
    float _e157 = w01_;
    int _e158 = row_2;
    int _e160 = size_lift(1);
    int _e162 = column_1;
    int _e167 = size_lift(2);
    float _e171 = read_lift(((((_e158 * _e160) + (_e162 + 1)) * _e167) + 0));
    float _e174 = w10_;
    int _e175 = row_2;
    int _e179 = size_lift(1);
    int _e181 = column_1;
    int _e184 = size_lift(2);
    float _e188 = read_lift((((((_e175 + 1) * _e179) + _e181) * _e184) + 0));
    float _e191 = w11_;
    int _e192 = row_2;
    int _e196 = size_lift(1);
    int _e198 = column_1;
    int _e203 = size_lift(2);
    float _e207 = read_lift((((((_e192 + 1) * _e196) + (_e198 + 1)) * _e203) + 0));
    raised = ((((_e143 * _e155) + (_e157 * _e171)) + (_e174 * _e188)) + (_e191 * _e207));
    float _e210 = w00_;
    int _e211 = row_2;
    int _e213 = size_lift(1);
    int _e215 = column_1;
    int _e218 = size_lift(2);
    float _e222 = read_lift(((((_e211 * _e213) + _e215) * _e218) + 1));
    float _e224 = w01_;
    int _e225 = row_2;
    int _e227 = size_lift(1);
    int _e229 = column_1;
    int _e234 = size_lift(2);
    float _e238 = read_lift(((((_e225 * _e227) + (_e229 + 1)) * _e234) + 1));
    float _e241 = w10_;
    int _e242 = row_2;
    int _e246 = size_lift(1);
    int _e248 = column_1;
    int _e251 = size_lift(2);
    float _e255 = read_lift((((((_e242 + 1) * _e246) + _e248) * _e251) + 1));
    float _e258 = w11_;
    int _e259 = row_2;
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
    float x_11 = 0.0;
    if ((angular_radius <= 0.0)) {
        return ((elevation > 0.0) ? 1.0 : 0.0);
    }
    x_11 = (elevation / angular_radius);
    float _e11 = x_11;
    if ((_e11 >= 1.0)) {
        return 1.0;
    }
    float _e15 = x_11;
    if ((_e15 <= -1.0)) {
        return 0.0;
    }
    float _e19 = x_11;
    float _e22 = x_11;
    float _e23 = x_11;
    float _e24 = x_11;
    return ((acos(-(_e19)) + (_e22 * sqrt((1.0 - (_e23 * _e24))))) / 3.1415927);
}

Several_f32_f32_ visible_spread(float elevation_1, float angular_radius_1) {
    float x_12 = 0.0;
    float rest = 0.0;
    float area = 0.0;
    float mean = 0.0;
    float square = 0.0;
    float deviation = 0.0;
    x_12 = (elevation_1 / angular_radius_1);
    float _e9 = x_12;
    if ((_e9 >= 1.0)) {
        return Several_f32_f32_(elevation_1, (0.5 * angular_radius_1));
    }
    float _e15 = x_12;
    float _e18 = x_12;
    rest = sqrt(max(((1.0 - _e15) * (1.0 + _e18)), 0.0));
    float _e25 = x_12;
    float _e28 = x_12;
    float _e29 = rest;
    area = (acos(-(_e25)) + (_e28 * _e29));
    float _e32 = area;
    if ((_e32 < 1e-9)) {
        return Several_f32_f32_(0.0, 0.0);
    }
    float _e38 = rest;
    float _e41 = rest;
    float _e43 = rest;
    float _e45 = area;
    mean = ((((2.0 * _e38) * _e41) * _e43) / (3.0 * _e45));
    float _e49 = x_12;
    float _e53 = x_12;
    float _e54 = rest;
    float _e56 = x_12;
    float _e59 = x_12;
    float _e65 = area;
    square = (((1.5707964 + asin(_e49)) - ((_e53 * _e54) * (1.0 - ((2.0 * _e56) * _e59)))) / (4.0 * _e65));
    float _e69 = square;
    float _e70 = mean;
    float _e71 = mean;
    deviation = sqrt(max((_e69 - (_e70 * _e71)), 0.0));
    float _e77 = mean;
    float _e80 = deviation;
    return Several_f32_f32_((elevation_1 + (angular_radius_1 * _e77)), (angular_radius_1 * _e80));
}

Several_f32_f32_f32_ star_points(float x_13, float mu_s_4, float bottom_1, float top_1, float star_radius) {
    float seen = 0.0;
    float squeeze_1 = 0.0;
    float elevation_2 = 0.0;
    float received = 0.0;
    float mean_1 = 0.0;
    float deviation_1 = 0.0;
    float middle = 0.0;
    float apart = 0.0;
    float lowest_1 = 0.0;
    bool local_1 = false;
    bool local_2 = false;
    Several_f32_f32_f32_ _e14 = seen_star(x_13, mu_s_4, bottom_1, top_1);
    seen = _e14.v0_;
    squeeze_1 = _e14.v1_;
    elevation_2 = _e14.v2_;
    float _e18 = squeeze_1;
    float _e19 = elevation_2;
    float _e20 = visible_fraction(_e19, star_radius);
    received = (_e18 * _e20);
    float _e22 = received;
    if (!((_e22 <= 0.0))) {
        local_1 = (star_radius <= 0.0);
    } else {
        local_1 = true;
    }
    bool _e31 = local_1;
    if (!(_e31)) {
        float _e35 = elevation_2;
        local_2 = (_e35 > (16.0 * star_radius));
    } else {
        local_2 = true;
    }
    bool _e40 = local_2;
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
    middle = (_e49 + ((_e50 * (bottom_1 / x_13)) * (_e53 - _e54)));
    float _e58 = squeeze_1;
    float _e61 = deviation_1;
    apart = ((_e58 * (bottom_1 / x_13)) * _e61);
    float _e63 = horizon_cosine(x_13, bottom_1);
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
    bool local_3 = false;
    bool local_4 = false;
    if ((0.0 < cut)) {
        float _e11 = march_line_1_edges[(count - 1)];
        local_3 = (cut < _e11);
    } else {
        local_3 = false;
    }
    bool _e14 = local_3;
    if (!(!(_e14))) {
        local_4 = (count >= 64);
    } else {
        local_4 = true;
    }
    bool _e22 = local_4;
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
    float x_14 = 0.0;
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
                    x_14 = (float(_e40) / 1.0);
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
                        float _e55 = x_14;
                        float _e59 = x_14;
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
                        float _e76 = x_14;
                        float _e78 = x_14;
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
            int _e126 = k_1;
            k_1 = (_e126 + 1);
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
            c_1 = 0;
            bool loop_init_5 = true;
            while(true) {
                if (!loop_init_5) {
                    int _e123 = c_1;
                    c_1 = (_e123 + 1);
                }
                loop_init_5 = false;
                int _e87 = c_1;
                float _e91 = _group_0_binding_0_fs.counts.x;
                if ((_e87 < int(_e91))) {
                } else {
                    break;
                }
                {
                    int _e94 = node_3;
                    int _e96 = size_density(1);
                    int _e98 = c_1;
                    float _e100 = read_density(((_e94 * _e96) + _e98));
                    here_1 = _e100;
                    int _e102 = c_1;
                    int _e105 = k_1;
                    float _e108 = here_1;
                    int _e109 = node_3;
                    int _e113 = size_density(1);
                    int _e115 = c_1;
                    float _e117 = read_density((((_e109 + 1) * _e113) + _e115));
                    float _e118 = here_1;
                    float _e120 = share_1;
                    columns_along_1_density[((_e102 * 24) + _e105)] = (_e108 + ((_e117 - _e118) * _e120));
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
    bool local_5 = false;
    float _e14 = read_rules(rule_1);
    n_1 = int(_e14);
    c_2 = 0;
    bool loop_init_6 = true;
    while(true) {
        if (!loop_init_6) {
            int _e28 = c_2;
            c_2 = (_e28 + 1);
        }
        loop_init_6 = false;
        int _e17 = c_2;
        float _e21 = _group_0_binding_0_fs.counts.x;
        if ((_e17 < int(_e21))) {
        } else {
            break;
        }
        {
            int _e25 = c_2;
            look_1_totals[_e25] = 0.0;
        }
    }
    march_line_1_cuts[0] = 0.0;
    march_line_1_cuts[1] = 0.0;
    march_line_1_cuts[2] = 0.0;
    reached = 0.0;
    at_4 = 0.0;
    panel = 0;
    bool loop_init_7 = true;
    while(true) {
        if (!loop_init_7) {
            int _e164 = panel;
            panel = (_e164 + 1);
        }
        loop_init_7 = false;
        int _e43 = panel;
        if ((_e43 < (count_3 - 1))) {
        } else {
            break;
        }
        {
            int _e48 = panel;
            float _e50 = march_line_1_edges[_e48];
            int _e52 = panel;
            float _e56 = march_line_1_edges[(_e52 + 1)];
            float _e61 = march_line_1_edges[(count_3 - 1)];
            place_panel_2_(r_13, mu_12, _e50, _e56, _e61, rule_1);
            k_2 = 0;
            bool loop_init_8 = true;
            while(true) {
                if (!loop_init_8) {
                    int _e161 = k_2;
                    k_2 = (_e161 + 1);
                }
                loop_init_8 = false;
                int _e63 = k_2;
                int _e64 = n_1;
                if ((_e63 < _e64)) {
                } else {
                    break;
                }
                {
                    float _e66 = reached;
                    depth_1 = _e66;
                    c_2 = 0;
                    bool loop_init_9 = true;
                    while(true) {
                        if (!loop_init_9) {
                            int _e103 = c_2;
                            c_2 = (_e103 + 1);
                        }
                        loop_init_9 = false;
                        int _e68 = c_2;
                        float _e72 = _group_0_binding_0_fs.counts.x;
                        if ((_e68 < int(_e72))) {
                        } else {
                            break;
                        }
                        {
                            int _e76 = c_2;
                            int _e79 = k_2;
                            float _e82 = columns_along_1_density[((_e76 * 24) + _e79)];
                            int _e84 = k_2;
                            float _e86 = columns_along_1_weight[_e84];
                            amount = (_e82 * _e86);
                            int _e89 = c_2;
                            int _e92 = c_2;
                            float _e94 = look_1_totals[_e92];
                            float _e95 = amount;
                            look_1_totals[_e89] = (_e94 + _e95);
                            float _e97 = depth_1;
                            int _e98 = c_2;
                            float _e99 = read_strongest(_e98);
                            float _e100 = amount;
                            depth_1 = (_e97 + (_e99 * _e100));
                        }
                    }
                    float _e106 = depth_1;
                    float _e107 = reached;
                    if ((_e106 > _e107)) {
                        which = 0;
                        bool loop_init_10 = true;
                        while(true) {
                            if (!loop_init_10) {
                                int _e153 = which;
                                which = (_e153 + 1);
                            }
                            loop_init_10 = false;
                            int _e110 = which;
                            if ((_e110 < 3)) {
                            } else {
                                break;
                            }
                            {
                                int _e113 = which;
                                int _e119 = which;
                                wanted = ((_e119 == 0) ? 0.5 : ((_e113 == 1) ? 3.0 : 12.0));
                                float _e124 = reached;
                                float _e125 = wanted;
                                if ((_e124 < _e125)) {
                                    float _e129 = depth_1;
                                    float _e130 = wanted;
                                    local_5 = (_e129 >= _e130);
                                } else {
                                    local_5 = false;
                                }
                                bool _e133 = local_5;
                                if (_e133) {
                                    int _e135 = which;
                                    float _e137 = at_4;
                                    int _e139 = k_2;
                                    float _e141 = columns_along_1_distance_1_[_e139];
                                    float _e142 = at_4;
                                    float _e144 = wanted;
                                    float _e145 = reached;
                                    float _e148 = depth_1;
                                    float _e149 = reached;
                                    march_line_1_cuts[_e135] = (_e137 + (((_e141 - _e142) * (_e144 - _e145)) / (_e148 - _e149)));
                                }
                            }
                        }
                    }
                    float now_3_1 = depth_1;
                    int _e158 = k_2;
                    float now_4_1 = columns_along_1_distance_1_[_e158];
                    reached = now_3_1;
                    at_4 = now_4_1;
                }
            }
        }
    }
    float _e167 = reached;
    return _e167;
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
    bool loop_init_11 = true;
    while(true) {
        if (!loop_init_11) {
            int _e126 = k_3;
            k_3 = (_e126 + 1);
        }
        loop_init_11 = false;
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
            c_3 = 0;
            bool loop_init_12 = true;
            while(true) {
                if (!loop_init_12) {
                    int _e123 = c_3;
                    c_3 = (_e123 + 1);
                }
                loop_init_12 = false;
                int _e87 = c_3;
                float _e91 = _group_0_binding_0_fs.counts.x;
                if ((_e87 < int(_e91))) {
                } else {
                    break;
                }
                {
                    int _e94 = node_4;
                    int _e96 = size_density(1);
                    int _e98 = c_3;
                    float _e100 = read_density(((_e94 * _e96) + _e98));
                    here_2 = _e100;
                    int _e102 = c_3;
                    int _e105 = k_3;
                    float _e108 = here_2;
                    int _e109 = node_4;
                    int _e113 = size_density(1);
                    int _e115 = c_3;
                    float _e117 = read_density((((_e109 + 1) * _e113) + _e115));
                    float _e118 = here_2;
                    float _e120 = share_2;
                    march_line_1_density[((_e102 * 24) + _e105)] = (_e108 + ((_e117 - _e118) * _e120));
                }
            }
        }
    }
    return;
}

void panel_columns_1_(int rule_3) {
    int n_3 = 0;
    int k_4 = 0;
    int c_4 = 0;
    int j = 0;
    float share_3 = 0.0;
    float _e6 = read_rules(rule_3);
    n_3 = int(_e6);
    k_4 = 0;
    bool loop_init_13 = true;
    while(true) {
        if (!loop_init_13) {
            int _e121 = k_4;
            k_4 = (_e121 + 1);
        }
        loop_init_13 = false;
        int _e9 = k_4;
        int _e10 = n_3;
        if ((_e9 < _e10)) {
        } else {
            break;
        }
        {
            c_4 = 0;
            bool loop_init_14 = true;
            while(true) {
                if (!loop_init_14) {
                    int _e28 = c_4;
                    c_4 = (_e28 + 1);
                }
                loop_init_14 = false;
                int _e13 = c_4;
                float _e17 = _group_0_binding_0_fs.counts.x;
                if ((_e13 < int(_e17))) {
                } else {
                    break;
                }
                {
                    int _e21 = c_4;
                    int _e24 = k_4;
                    march_line_1_columns[((_e21 * 24) + _e24)] = 0.0;
                }
            }
            j = 0;
            bool loop_init_15 = true;
            while(true) {
                if (!loop_init_15) {
                    int _e85 = j;
                    j = (_e85 + 1);
                }
                loop_init_15 = false;
                int _e32 = j;
                int _e33 = n_3;
                if ((_e32 < _e33)) {
                } else {
                    break;
                }
                {
                    int _e37 = n_3;
                    int _e41 = k_4;
                    int _e42 = n_3;
                    int _e45 = j;
                    float _e47 = read_rules(((((rule_3 + 1) + (2 * _e37)) + (_e41 * _e42)) + _e45));
                    share_3 = _e47;
                    c_4 = 0;
                    bool loop_init_16 = true;
                    while(true) {
                        if (!loop_init_16) {
                            int _e82 = c_4;
                            c_4 = (_e82 + 1);
                        }
                        loop_init_16 = false;
                        int _e49 = c_4;
                        float _e53 = _group_0_binding_0_fs.counts.x;
                        if ((_e49 < int(_e53))) {
                        } else {
                            break;
                        }
                        {
                            int _e57 = c_4;
                            int _e60 = k_4;
                            int _e64 = c_4;
                            int _e67 = k_4;
                            float _e70 = march_line_1_columns[((_e64 * 24) + _e67)];
                            float _e71 = share_3;
                            int _e73 = c_4;
                            int _e76 = j;
                            float _e79 = march_line_1_amounts[((_e73 * 24) + _e76)];
                            march_line_1_columns[((_e57 * 24) + _e60)] = (_e70 + (_e71 * _e79));
                        }
                    }
                }
            }
            c_4 = 0;
            bool loop_init_17 = true;
            while(true) {
                if (!loop_init_17) {
                    int _e118 = c_4;
                    c_4 = (_e118 + 1);
                }
                loop_init_17 = false;
                int _e89 = c_4;
                float _e93 = _group_0_binding_0_fs.counts.x;
                if ((_e89 < int(_e93))) {
                } else {
                    break;
                }
                {
                    int _e97 = c_4;
                    int _e100 = k_4;
                    int _e104 = c_4;
                    float _e106 = march_line_1_before[_e104];
                    int _e108 = c_4;
                    int _e111 = k_4;
                    float _e114 = march_line_1_columns[((_e108 * 24) + _e111)];
                    march_line_1_columns[((_e97 * 24) + _e100)] = (_e106 + max(_e114, 0.0));
                }
            }
        }
    }
    c_4 = 0;
    bool loop_init_18 = true;
    while(true) {
        if (!loop_init_18) {
            int _e155 = c_4;
            c_4 = (_e155 + 1);
        }
        loop_init_18 = false;
        int _e125 = c_4;
        float _e129 = _group_0_binding_0_fs.counts.x;
        if ((_e125 < int(_e129))) {
        } else {
            break;
        }
        {
            k_4 = 0;
            bool loop_init_19 = true;
            while(true) {
                if (!loop_init_19) {
                    int _e152 = k_4;
                    k_4 = (_e152 + 1);
                }
                loop_init_19 = false;
                int _e133 = k_4;
                int _e134 = n_3;
                if ((_e133 < _e134)) {
                } else {
                    break;
                }
                {
                    int _e137 = c_4;
                    int _e140 = c_4;
                    float _e142 = march_line_1_before[_e140];
                    int _e144 = c_4;
                    int _e147 = k_4;
                    float _e150 = march_line_1_amounts[((_e144 * 24) + _e147)];
                    march_line_1_before[_e137] = (_e142 + _e150);
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
    bool loop_init_20 = true;
    while(true) {
        if (!loop_init_20) {
            int _e21 = c_5;
            c_5 = (_e21 + 1);
        }
        loop_init_20 = false;
        int _e6 = c_5;
        if ((_e6 < constituents)) {
        } else {
            break;
        }
        {
            vec4 _e8 = tau;
            int _e9 = c_5;
            vec4 _e14 = read_extinction(((1 * _e9) + 0));
            int _e16 = c_5;
            float _e18 = march_line_1_depths[_e16];
            tau = (_e8 + (_e14 * _e18));
        }
    }
    vec4 _e24 = tau;
    return exp((vec4(0.0) - _e24));
}

void columns_to_top_1_(float r_15, float mu_14, float bottom_2, float top_2) {
    float x_15 = 0.0;
    int row_3 = 0;
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
    x_15 = (_e17 * float((_e19 - 1)));
    float _e24 = x_15;
    int _e27 = size_columns(0);
    row_3 = min(int(_e24), (_e27 - 2));
    float _e31 = x_15;
    int _e32 = row_3;
    f_2 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_15, mu_14, bottom_2, top_2);
    int _e37 = size_columns(1);
    x_15 = (_e35 * float((_e37 - 1)));
    float _e42 = x_15;
    int _e45 = size_columns(1);
    place_1 = min(int(_e42), (_e45 - 2));
    float _e49 = x_15;
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
    float now_3_2 = (_e65 * (1.0 - _e66));
    float _e70 = f_2;
    float _e71 = e_1;
    float now_4_2 = (_e70 * _e71);
    w10_1 = now_3_2;
    w11_1 = now_4_2;
    float _e73 = distance_to_top(r_15, mu_14, top_2);
    distance_1_3 = _e73;
    c_6 = 0;
    bool loop_init_21 = true;
    while(true) {
        if (!loop_init_21) {
            int _e261 = c_6;
            c_6 = (_e261 + 1);
        }
        loop_init_21 = false;
        int _e75 = c_6;
        int _e77 = size_columns(2);
        if ((_e75 < _e77)) {
        } else {
            break;
        }
        {
            float _e79 = w00_1;
            int _e80 = row_3;
            int _e82 = size_columns(1);
            int _e84 = place_1;
            int _e87 = size_columns(2);
            int _e89 = c_6;
            int _e92 = size_columns(3);
            float _e96 = read_columns(((((((_e80 * _e82) + _e84) * _e87) + _e89) * _e92) + 0));
            float _e98 = w01_1;
            int _e99 = row_3;
            int _e101 = size_columns(1);
            int _e103 = place_1;
            int _e108 = size_columns(2);
            int _e110 = c_6;
            int _e113 = size_columns(3);
            float _e117 = read_columns(((((((_e99 * _e101) + (_e103 + 1)) * _e108) + _e110) * _e113) + 0));
            float _e120 = w10_1;
            int _e121 = row_3;
            int _e125 = size_columns(1);
            int _e127 = place_1;
            int _e130 = size_columns(2);
            int _e132 = c_6;
            int _e135 = size_columns(3);
            float _e139 = read_columns((((((((_e121 + 1) * _e125) + _e127) * _e130) + _e132) * _e135) + 0));
            float _e142 = w11_1;
            int _e143 = row_3;
            int _e147 = size_columns(1);
            int _e149 = place_1;
            int _e154 = size_columns(2);
            int _e156 = c_6;
            int _e159 = size_columns(3);
            float _e163 = read_columns((((((((_e143 + 1) * _e147) + (_e149 + 1)) * _e154) + _e156) * _e159) + 0));
            scale = ((((_e79 * _e96) + (_e98 * _e117)) + (_e120 * _e139)) + (_e142 * _e163));
            float _e166 = w00_1;
            int _e167 = row_3;
            int _e169 = size_columns(1);
            int _e171 = place_1;
            int _e174 = size_columns(2);
            int _e176 = c_6;
            int _e179 = size_columns(3);
            float _e183 = read_columns(((((((_e167 * _e169) + _e171) * _e174) + _e176) * _e179) + 1));
            float _e185 = w01_1;
            int _e186 = row_3;
            int _e188 = size_columns(1);
            int _e190 = place_1;
            int _e195 = size_columns(2);
            int _e197 = c_6;
            int _e200 = size_columns(3);
            float _e204 = read_columns(((((((_e186 * _e188) + (_e190 + 1)) * _e195) + _e197) * _e200) + 1));
            float _e207 = w10_1;
            int _e208 = row_3;
            int _e212 = size_columns(1);
            int _e214 = place_1;
            int _e217 = size_columns(2);
            int _e219 = c_6;
            int _e222 = size_columns(3);
            float _e226 = read_columns((((((((_e208 + 1) * _e212) + _e214) * _e217) + _e219) * _e222) + 1));
            float _e229 = w11_1;
            int _e230 = row_3;
            int _e234 = size_columns(1);
            int _e236 = place_1;
            int _e241 = size_columns(2);
            int _e243 = c_6;
            int _e246 = size_columns(3);
            float _e250 = read_columns((((((((_e230 + 1) * _e234) + (_e236 + 1)) * _e241) + _e243) * _e246) + 1));
            scaled = ((((_e166 * _e183) + (_e185 * _e204)) + (_e207 * _e226)) + (_e229 * _e250));
            int _e254 = c_6;
            float _e256 = distance_1_3;
            float _e257 = scaled;
            float _e259 = scale;
            march_line_1_here[_e254] = ((_e256 * _e257) / _e259);
        }
    }
    return;
}

void columns_to_top_2_(float r_16, float mu_15, float bottom_3, float top_3) {
    float x_16 = 0.0;
    int row_4 = 0;
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
    x_16 = (_e17 * float((_e19 - 1)));
    float _e24 = x_16;
    int _e27 = size_columns(0);
    row_4 = min(int(_e24), (_e27 - 2));
    float _e31 = x_16;
    int _e32 = row_4;
    f_3 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_16, mu_15, bottom_3, top_3);
    int _e37 = size_columns(1);
    x_16 = (_e35 * float((_e37 - 1)));
    float _e42 = x_16;
    int _e45 = size_columns(1);
    place_2 = min(int(_e42), (_e45 - 2));
    float _e49 = x_16;
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
    float now_3_3 = (_e65 * (1.0 - _e66));
    float _e70 = f_3;
    float _e71 = e_2;
    float now_4_3 = (_e70 * _e71);
    w10_2 = now_3_3;
    w11_2 = now_4_3;
    float _e73 = distance_to_top(r_16, mu_15, top_3);
    distance_1_4 = _e73;
    c_7 = 0;
    bool loop_init_22 = true;
    while(true) {
        if (!loop_init_22) {
            int _e261 = c_7;
            c_7 = (_e261 + 1);
        }
        loop_init_22 = false;
        int _e75 = c_7;
        int _e77 = size_columns(2);
        if ((_e75 < _e77)) {
        } else {
            break;
        }
        {
            float _e79 = w00_2;
            int _e80 = row_4;
            int _e82 = size_columns(1);
            int _e84 = place_2;
            int _e87 = size_columns(2);
            int _e89 = c_7;
            int _e92 = size_columns(3);
            float _e96 = read_columns(((((((_e80 * _e82) + _e84) * _e87) + _e89) * _e92) + 0));
            float _e98 = w01_2;
            int _e99 = row_4;
            int _e101 = size_columns(1);
            int _e103 = place_2;
            int _e108 = size_columns(2);
            int _e110 = c_7;
            int _e113 = size_columns(3);
            float _e117 = read_columns(((((((_e99 * _e101) + (_e103 + 1)) * _e108) + _e110) * _e113) + 0));
            float _e120 = w10_2;
            int _e121 = row_4;
            int _e125 = size_columns(1);
            int _e127 = place_2;
            int _e130 = size_columns(2);
            int _e132 = c_7;
            int _e135 = size_columns(3);
            float _e139 = read_columns((((((((_e121 + 1) * _e125) + _e127) * _e130) + _e132) * _e135) + 0));
            float _e142 = w11_2;
            int _e143 = row_4;
            int _e147 = size_columns(1);
            int _e149 = place_2;
            int _e154 = size_columns(2);
            int _e156 = c_7;
            int _e159 = size_columns(3);
            float _e163 = read_columns((((((((_e143 + 1) * _e147) + (_e149 + 1)) * _e154) + _e156) * _e159) + 0));
            scale_1 = ((((_e79 * _e96) + (_e98 * _e117)) + (_e120 * _e139)) + (_e142 * _e163));
            float _e166 = w00_2;
            int _e167 = row_4;
            int _e169 = size_columns(1);
            int _e171 = place_2;
            int _e174 = size_columns(2);
            int _e176 = c_7;
            int _e179 = size_columns(3);
            float _e183 = read_columns(((((((_e167 * _e169) + _e171) * _e174) + _e176) * _e179) + 1));
            float _e185 = w01_2;
            int _e186 = row_4;
            int _e188 = size_columns(1);
            int _e190 = place_2;
            int _e195 = size_columns(2);
            int _e197 = c_7;
            int _e200 = size_columns(3);
            float _e204 = read_columns(((((((_e186 * _e188) + (_e190 + 1)) * _e195) + _e197) * _e200) + 1));
            float _e207 = w10_2;
            int _e208 = row_4;
            int _e212 = size_columns(1);
            int _e214 = place_2;
            int _e217 = size_columns(2);
            int _e219 = c_7;
            int _e222 = size_columns(3);
            float _e226 = read_columns((((((((_e208 + 1) * _e212) + _e214) * _e217) + _e219) * _e222) + 1));
            float _e229 = w11_2;
            int _e230 = row_4;
            int _e234 = size_columns(1);
            int _e236 = place_2;
            int _e241 = size_columns(2);
            int _e243 = c_7;
            int _e246 = size_columns(3);
            float _e250 = read_columns((((((((_e230 + 1) * _e234) + (_e236 + 1)) * _e241) + _e243) * _e246) + 1));
            scaled_1 = ((((_e166 * _e183) + (_e185 * _e204)) + (_e207 * _e226)) + (_e229 * _e250));
            int _e254 = c_7;
            float _e256 = distance_1_4;
            float _e257 = scaled_1;
            float _e259 = scale_1;
            march_line_1_there[_e254] = ((_e256 * _e257) / _e259);
        }
    }
    return;
}

vec4 through_columns_3_(int constituents_1) {
    vec4 tau_1 = vec4(0.0);
    int c_8 = 0;
    tau_1 = vec4(0.0);
    c_8 = 0;
    bool loop_init_23 = true;
    while(true) {
        if (!loop_init_23) {
            int _e21 = c_8;
            c_8 = (_e21 + 1);
        }
        loop_init_23 = false;
        int _e6 = c_8;
        if ((_e6 < constituents_1)) {
        } else {
            break;
        }
        {
            vec4 _e8 = tau_1;
            int _e9 = c_8;
            vec4 _e14 = read_extinction(((1 * _e9) + 0));
            int _e16 = c_8;
            float _e18 = march_line_1_here[_e16];
            tau_1 = (_e8 + (_e14 * _e18));
        }
    }
    vec4 _e24 = tau_1;
    return exp((vec4(0.0) - _e24));
}

vec4 through_columns_4_(int constituents_2) {
    vec4 tau_2 = vec4(0.0);
    int c_9 = 0;
    tau_2 = vec4(0.0);
    c_9 = 0;
    bool loop_init_24 = true;
    while(true) {
        if (!loop_init_24) {
            int _e21 = c_9;
            c_9 = (_e21 + 1);
        }
        loop_init_24 = false;
        int _e6 = c_9;
        if ((_e6 < constituents_2)) {
        } else {
            break;
        }
        {
            vec4 _e8 = tau_2;
            int _e9 = c_9;
            vec4 _e14 = read_extinction(((1 * _e9) + 0));
            int _e16 = c_9;
            float _e18 = march_line_1_there[_e16];
            tau_2 = (_e8 + (_e14 * _e18));
        }
    }
    vec4 _e24 = tau_2;
    return exp((vec4(0.0) - _e24));
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
    bool loop_init_25 = true;
    while(true) {
        if (!loop_init_25) {
            int _e21 = c_10;
            c_10 = (_e21 + 1);
        }
        loop_init_25 = false;
        int _e6 = c_10;
        if ((_e6 < constituents_4)) {
        } else {
            break;
        }
        {
            vec4 _e8 = tau_3;
            int _e9 = c_10;
            vec4 _e14 = read_extinction(((1 * _e9) + 0));
            int _e16 = c_10;
            float _e18 = march_line_1_before[_e16];
            tau_3 = (_e8 + (_e14 * _e18));
        }
    }
    vec4 _e24 = tau_3;
    return exp((vec4(0.0) - _e24));
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
    bool local_6 = false;
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
    kind = ((_e71 < 9.0) ? 1 : 2);
    bool _e77 = day;
    if (_e77) {
        float _e80 = slant;
        local_6 = (_e80 < 4.0);
    } else {
        local_6 = false;
    }
    bool _e84 = local_6;
    if (_e84) {
        kind = 0;
    }
    int _e86 = kind;
    float _e87 = read_rules(_e86);
    rule_4 = int(_e87);
    int _e89 = rule_4;
    float _e90 = read_rules(_e89);
    n_4 = int(_e90);
    attempt = 0;
    bool loop_init_26 = true;
    while(true) {
        if (!loop_init_26) {
            int _e114 = attempt;
            attempt = (_e114 + 1);
        }
        loop_init_26 = false;
        int _e93 = attempt;
        if ((_e93 < 2)) {
        } else {
            break;
        }
        {
            int _e96 = count_4;
            int _e97 = rule_4;
            float _e98 = columns_along_1_(r_17, mu_16, _e96, _e97);
            if ((_e98 <= 15.0)) {
                break;
            }
            which_1 = 0;
            bool loop_init_27 = true;
            while(true) {
                if (!loop_init_27) {
                    int _e111 = which_1;
                    which_1 = (_e111 + 1);
                }
                loop_init_27 = false;
                int _e102 = which_1;
                if ((_e102 < 3)) {
                } else {
                    break;
                }
                {
                    int _e105 = count_4;
                    int _e107 = which_1;
                    float _e109 = march_line_1_cuts[_e107];
                    int _e110 = insert_edge_1_(_e105, _e109);
                    count_4 = _e110;
                }
            }
        }
    }
    scatters = 0.0;
    c_11 = 0;
    bool loop_init_28 = true;
    while(true) {
        if (!loop_init_28) {
            int _e139 = c_11;
            c_11 = (_e139 + 1);
        }
        loop_init_28 = false;
        int _e119 = c_11;
        float _e123 = _group_0_binding_0_fs.counts.x;
        if ((_e119 < int(_e123))) {
        } else {
            break;
        }
        {
            float _e126 = scatters;
            int _e127 = c_11;
            float _e128 = read_brightest(_e127);
            int _e130 = c_11;
            float _e132 = look_1_totals[_e130];
            scatters = (_e126 + (_e128 * _e132));
            int _e136 = c_11;
            march_line_1_before[_e136] = 0.0;
        }
    }
    float _e142 = scatters;
    bool _e147 = day;
    faint = (_e147 ? (0.0005 * min(_e142, 1.0)) : 0.0);
    vec4 now_4_4 = vec4(0.0);
    vec4 now_5_ = vec4(0.0);
    vec4 now_6_ = vec4(0.0);
    air = now_4_4;
    first_5 = now_5_;
    second_1 = now_6_;
    float _e159 = _group_0_binding_0_fs.counts.y;
    float _e166 = _group_0_binding_0_fs.counts.y;
    block = (1 * (1 + (((int(_e159) + 1) * (int(_e166) + 2)) / 2)));
    panel_1 = 0;
    bool loop_init_29 = true;
    while(true) {
        if (!loop_init_29) {
            int _e459 = panel_1;
            panel_1 = (_e459 + 1);
        }
        loop_init_29 = false;
        int _e178 = panel_1;
        int _e179 = count_4;
        if ((_e178 < (_e179 - 1))) {
        } else {
            break;
        }
        {
            int _e184 = panel_1;
            float _e186 = march_line_1_edges[_e184];
            int _e188 = panel_1;
            float _e192 = march_line_1_edges[(_e188 + 1)];
            int _e194 = count_4;
            float _e198 = march_line_1_edges[(_e194 - 1)];
            int _e199 = rule_4;
            place_panel_1_(r_17, mu_16, _e186, _e192, _e198, _e199);
            c_11 = 0;
            bool loop_init_30 = true;
            while(true) {
                if (!loop_init_30) {
                    int _e235 = c_11;
                    c_11 = (_e235 + 1);
                }
                loop_init_30 = false;
                int _e201 = c_11;
                float _e205 = _group_0_binding_0_fs.counts.x;
                if ((_e201 < int(_e205))) {
                } else {
                    break;
                }
                {
                    k_5 = 0;
                    bool loop_init_31 = true;
                    while(true) {
                        if (!loop_init_31) {
                            int _e232 = k_5;
                            k_5 = (_e232 + 1);
                        }
                        loop_init_31 = false;
                        int _e209 = k_5;
                        int _e210 = n_4;
                        if ((_e209 < _e210)) {
                        } else {
                            break;
                        }
                        {
                            int _e213 = c_11;
                            int _e216 = k_5;
                            int _e220 = c_11;
                            int _e223 = k_5;
                            float _e226 = march_line_1_density[((_e220 * 24) + _e223)];
                            int _e228 = k_5;
                            float _e230 = march_line_1_weight[_e228];
                            march_line_1_amounts[((_e213 * 24) + _e216)] = (_e226 * _e230);
                        }
                    }
                }
            }
            int _e238 = rule_4;
            panel_columns_1_(_e238);
            k_5 = 0;
            bool loop_init_32 = true;
            while(true) {
                if (!loop_init_32) {
                    int _e456 = k_5;
                    k_5 = (_e456 + 1);
                }
                loop_init_32 = false;
                int _e240 = k_5;
                int _e241 = n_4;
                if ((_e240 < _e241)) {
                } else {
                    break;
                }
                {
                    int _e244 = k_5;
                    float _e246 = march_line_1_radius[_e244];
                    float _e247 = bottom_4;
                    float _e249 = top_4;
                    q = min(max(_e246, _e247), _e249);
                    int _e252 = k_5;
                    float _e254 = march_line_1_distance_1_[_e252];
                    t = _e254;
                    float _e256 = t;
                    float _e258 = q;
                    mu_q = min(max((((r_17 * mu_16) + _e256) / _e258), -1.0), 1.0);
                    float _e265 = t;
                    float _e268 = q;
                    mu_sq = min(max((((r_17 * mu_s_5) + (_e265 * nu_2)) / _e268), -1.0), 1.0);
                    nu_q = nu_2;
                    depth_2 = 0.0;
                    c_11 = 0;
                    bool loop_init_33 = true;
                    while(true) {
                        if (!loop_init_33) {
                            int _e314 = c_11;
                            c_11 = (_e314 + 1);
                        }
                        loop_init_33 = false;
                        int _e276 = c_11;
                        float _e280 = _group_0_binding_0_fs.counts.x;
                        if ((_e276 < int(_e280))) {
                        } else {
                            break;
                        }
                        {
                            int _e284 = c_11;
                            int _e287 = c_11;
                            int _e290 = k_5;
                            float _e293 = march_line_1_density[((_e287 * 24) + _e290)];
                            march_line_1_rho[_e284] = _e293;
                            int _e295 = c_11;
                            int _e298 = c_11;
                            int _e301 = k_5;
                            float _e304 = march_line_1_columns[((_e298 * 24) + _e301)];
                            march_line_1_depths[_e295] = _e304;
                            float _e305 = depth_2;
                            int _e306 = c_11;
                            float _e307 = read_brightest(_e306);
                            int _e309 = c_11;
                            float _e311 = march_line_1_rho[_e309];
                            depth_2 = (_e305 + (_e307 * _e311));
                        }
                    }
                    float _e320 = _group_0_binding_0_fs.shell.w;
                    if ((_e320 > 0.0)) {
                        float _e326 = _group_0_binding_0_fs.shell.w;
                        float _e331 = _group_0_binding_0_fs.counts.x;
                        float _e336 = march_line_1_depths[(int(_e331) - 1)];
                        float _e337 = bend_angle(r_17, mu_16, _e326, _e336);
                        angle_2 = _e337;
                        float _e338 = mu_q;
                        float _e339 = mu_sq;
                        float _e340 = angle_2;
                        Several_f32_f32_ _e341 = turned(_e338, _e339, nu_2, _e340);
                        mu_sq = _e341.v0_;
                        nu_q = _e341.v1_;
                        float _e344 = mu_sq;
                        mu_sq = min(max(_e344, -1.0), 1.0);
                    }
                    float _e352 = _group_0_binding_0_fs.counts.x;
                    vec4 _e354 = through_columns_1_(int(_e352));
                    int _e356 = k_5;
                    float _e358 = march_line_1_weight[_e356];
                    through = (_e354 * _e358);
                    if ((orders != 0)) {
                        float _e362 = q;
                        float _e363 = mu_sq;
                        float _e364 = bottom_4;
                        float _e365 = top_4;
                        float _e369 = _group_0_binding_0_fs.shell.z;
                        Several_f32_f32_f32_ _e370 = star_points(_e362, _e363, _e364, _e365, _e369);
                        seen_2 = _e370.v0_;
                        low_6 = _e370.v1_;
                        high_3 = _e370.v2_;
                        float _e374 = seen_2;
                        if ((_e374 > 0.0)) {
                            float _e377 = q;
                            float _e378 = low_6;
                            float _e379 = bottom_4;
                            float _e380 = top_4;
                            columns_to_top_1_(_e377, _e378, _e379, _e380);
                            float _e381 = high_3;
                            float _e382 = low_6;
                            if ((_e381 > _e382)) {
                                float _e384 = q;
                                float _e385 = high_3;
                                float _e386 = bottom_4;
                                float _e387 = top_4;
                                columns_to_top_2_(_e384, _e385, _e386, _e387);
                            }
                            vec4 _e388 = through;
                            float _e389 = seen_2;
                            float _e390 = high_3;
                            float _e391 = low_6;
                            float _e396 = _group_0_binding_0_fs.counts.x;
                            vec4 _e398 = star_at_1_(_e389, (_e390 > _e391), int(_e396));
                            star = (_e388 * _e398);
                            float _e403 = _group_0_binding_0_fs.peaks.y;
                            if ((int(_e403) >= 0)) {
                                vec4 _e407 = first_5;
                                vec4 _e408 = star;
                                float _e412 = _group_0_binding_0_fs.peaks.y;
                                vec4 _e416 = read_scattering((1 * int(_e412)));
                                float _e422 = _group_0_binding_0_fs.peaks.y;
                                float _e425 = march_line_1_rho[int(_e422)];
                                first_5 = (_e407 + ((_e408 * _e416) * _e425));
                            }
                            float _e431 = _group_0_binding_0_fs.peaks.z;
                            if ((int(_e431) >= 0)) {
                                vec4 _e435 = second_1;
                                vec4 _e436 = star;
                                float _e440 = _group_0_binding_0_fs.peaks.z;
                                vec4 _e444 = read_scattering((1 * int(_e440)));
                                float _e450 = _group_0_binding_0_fs.peaks.z;
                                float _e453 = march_line_1_rho[int(_e450)];
                                second_1 = (_e435 + ((_e436 * _e444) * _e453));
                            }
                        }
                    }
                }
            }
        }
    }
    c_11 = 0;
    bool loop_init_34 = true;
    while(true) {
        if (!loop_init_34) {
            int _e477 = c_11;
            c_11 = (_e477 + 1);
        }
        loop_init_34 = false;
        int _e463 = c_11;
        float _e467 = _group_0_binding_0_fs.counts.x;
        if ((_e463 < int(_e467))) {
        } else {
            break;
        }
        {
            int _e471 = c_11;
            int _e474 = c_11;
            float _e476 = march_line_1_before[_e474];
            look_1_totals[_e471] = _e476;
        }
    }
    vec4 _e482 = air;
    look_1_along[0] = _e482;
    float _e488 = _group_0_binding_0_fs.counts.x;
    vec4 _e490 = through_columns_2_(int(_e488));
    look_1_along[1] = _e490;
    vec4 _e493 = first_5;
    look_1_along[2] = _e493;
    vec4 _e496 = second_1;
    look_1_along[3] = _e496;
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
    float now_3_4 = _group_0_binding_0_fs.star.y;
    r_18 = now_1_4;
    start_mu = mu_17;
    start_mu_s = now_3_4;
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

void peaks_texel_1_(int column_2, int row_5, int columns, int rows) {
    bool sky_2 = false;
    float at_5 = 0.0;
    float azimuth = 0.0;
    float cos_azimuth_2 = 0.0;
    float sine_1_5 = 0.0;
    float mu_18 = 0.0;
    float side = 0.0;
    float half_sine_2 = 0.0;
    int layer = 0;
    sky_2 = (row_5 < rows);
    bool _e15 = sky_2;
    at_5 = (float((_e15 ? row_5 : (row_5 - rows))) / float((rows - 1)));
    azimuth = ((3.1415927 * float(column_2)) / float((columns - 1)));
    float _e29 = azimuth;
    float _e30 = cosine(_e29);
    cos_azimuth_2 = _e30;
    float _e34 = _group_0_binding_0_fs.observer.y;
    if ((_e34 > 0.5)) {
        float _e37 = at_5;
        bool _e38 = sky_2;
        float _e42 = _group_0_binding_0_fs.shell.x;
        float _e46 = _group_0_binding_0_fs.shell.y;
        float _e47 = impact_from_row(_e37, _e38, _e42, _e46);
        float _e51 = _group_0_binding_0_fs.observer.x;
        sine_1_5 = (_e47 / _e51);
        float _e53 = sine_1_5;
        float _e56 = sine_1_5;
        mu_18 = -(sqrt(max(((1.0 - _e53) * (1.0 + _e56)), 0.0)));
    } else {
        float _e64 = at_5;
        bool _e65 = sky_2;
        float _e69 = _group_0_binding_0_fs.observer.z;
        float _e73 = _group_0_binding_0_fs.observer.w;
        Several_f32_f32_ _e74 = direction_from_row(_e64, _e65, _e69, _e73);
        mu_18 = _e74.v0_;
        sine_1_5 = _e74.v1_;
    }
    float _e77 = cos_azimuth_2;
    float _e80 = cos_azimuth_2;
    side = sqrt(max(((1.0 - _e77) * (1.0 + _e80)), 0.0));
    float _e87 = sine_1_5;
    float _e88 = cos_azimuth_2;
    float _e90 = sine_1_5;
    float _e91 = side;
    float _e93 = mu_18;
    float _e97 = _group_0_binding_0_fs.star.z;
    float _e101 = _group_0_binding_0_fs.star.w;
    float _e102 = half_sine_between((_e87 * _e88), (_e90 * _e91), _e93, _e97, _e101);
    half_sine_2 = _e102;
    float _e103 = half_sine_2;
    phases_towards_1_(_e103);
    float _e104 = mu_18;
    float _e105 = sine_1_5;
    float _e106 = cos_azimuth_2;
    bool _e107 = sky_2;
    float _e109 = look_1_(_e104, _e105, _e106, !(_e107));
    layer = 0;
    bool loop_init_35 = true;
    while(true) {
        if (!loop_init_35) {
            int _e130 = layer;
            layer = (_e130 + 1);
        }
        loop_init_35 = false;
        int _e111 = layer;
        if ((_e111 < 4)) {
        } else {
            break;
        }
        {
            int _e115 = layer;
            int _e120 = layer;
            vec4 _e124 = peaks_texel_1_found[(1 * _e120)];
            sky_peaks_found[(1 * _e115)] = sqrt(sqrt(max(_e124, vec4(0.0))));
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
