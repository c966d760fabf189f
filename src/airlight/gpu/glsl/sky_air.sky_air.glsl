#version 300 es
// of sky_air.wgsl 90dcba792590a826, by naga-wasm@30.1.0
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
struct Several_f32_f32_f32_f32_ {
    float v0_;
    float v1_;
    float v2_;
    float v3_;
};
struct Layers {
    vec4 first;
    vec4 second;
};
layout(std140) uniform Frame_block_0Fragment { Frame _group_0_binding_0_fs; };

uniform highp sampler2D _group_0_binding_1_fs;

uniform highp sampler2D _group_0_binding_2_fs;

uniform highp sampler2D _group_0_binding_3_fs;

vec4 sky_air_found[4];

vec4 air_texel_1_phase[8];

vec4 air_texel_1_found[4];

float look_1_totals[8];

vec4 look_1_received[1];

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

float march_line_1_functions[325];

float ground_received_1_below[8];

float ground_received_1_above[8];

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

vec4 read_field(int index_18) {
    float _e4 = _group_0_binding_0_fs.table_field.x;
    int at_24 = (index_18 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_3_fs, ivec2((at_24 & 2047), (at_24 >> 11u)), 0);
    return _e14;
}

int size_sky(int axis_19) {
    float _e6 = _group_0_binding_0_fs.table_sky[(axis_19 + 1)];
    return int(_e6);
}

vec4 read_sky(int index_19) {
    float _e4 = _group_0_binding_0_fs.table_sky.x;
    int at_25 = (index_19 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_3_fs, ivec2((at_25 & 2047), (at_25 >> 11u)), 0);
    return _e14;
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
    float value_1 = (((quarter & 1) == 1) ? _e9 : _e8);
    return ((quarter >= 2) ? -(value_1) : value_1);
}

float cosine(float x_6) {
    bool local = false;
    float turns_2 = roundEven((x_6 * 0.63661975));
    float _e4 = rest_of_quarter(x_6, turns_2);
    int quarter_1 = (int(turns_2) & 3);
    float _e8 = cosine_of_quarter(_e4);
    float _e9 = sine_of_quarter(_e4);
    float value_2 = (((quarter_1 & 1) == 1) ? _e9 : _e8);
    if (!((quarter_1 == 1))) {
        local = (quarter_1 == 2);
    } else {
        local = true;
    }
    bool _e24 = local;
    return (_e24 ? -(value_2) : value_2);
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

float row_of(float q, float bottom_2, float top_2) {
    float fraction = 0.0;
    float x_14 = 0.0;
    int k = 0;
    fraction = min(max(((q - bottom_2) / (top_2 - bottom_2)), 0.0), 1.0);
    float _e13 = fraction;
    int _e16 = size_row(0);
    x_14 = (sqrt(_e13) * float((_e16 - 1)));
    float _e21 = x_14;
    int _e24 = size_row(0);
    k = min(int(_e21), (_e24 - 2));
    int _e28 = k;
    float _e29 = read_row(_e28);
    int _e30 = k;
    float _e33 = read_row((_e30 + 1));
    int _e34 = k;
    float _e35 = read_row(_e34);
    float _e37 = x_14;
    int _e38 = k;
    return (_e29 + ((_e33 - _e35) * (_e37 - float(_e38))));
}

float place_of(float mu_s_5) {
    float x_15 = 0.0;
    int k_1 = 0;
    int _e6 = size_place(0);
    x_15 = ((mu_s_5 + 1.0) * (0.5 * float((_e6 - 1))));
    float _e13 = x_15;
    int _e18 = size_place(0);
    k_1 = min(max(int(_e13), 0), (_e18 - 2));
    int _e22 = k_1;
    float _e23 = read_place(_e22);
    int _e24 = k_1;
    float _e27 = read_place((_e24 + 1));
    int _e28 = k_1;
    float _e29 = read_place(_e28);
    float _e31 = x_15;
    int _e32 = k_1;
    return (_e23 + ((_e27 - _e29) * (_e31 - float(_e32))));
}

vec4 between(int near, int far, int block, float w00_1, float w01_1, float w10_1, float w11_1) {
    vec4 _e7 = read_field(near);
    vec4 _e10 = read_field((near + block));
    vec4 _e13 = read_field(far);
    vec4 _e17 = read_field((far + block));
    return ((((w00_1 * _e7) + (w01_1 * _e10)) + (w10_1 * _e13)) + (w11_1 * _e17));
}

Several_f32_f32_f32_f32_ level_light(float x_16, float mu_s_6, float bottom_3, float top_3, float star_radius_1) {
    float received_1 = 0.0;
    float low_2 = 0.0;
    float high_1 = 0.0;
    Several_f32_f32_f32_ _e8 = star_points(x_16, mu_s_6, bottom_3, top_3, star_radius_1);
    received_1 = _e8.v0_;
    low_2 = _e8.v1_;
    high_1 = _e8.v2_;
    float _e12 = low_2;
    float now_2_1 = max(_e12, 0.0);
    float _e15 = high_1;
    float now_3_1 = max(_e15, 0.0);
    low_2 = now_2_1;
    high_1 = now_3_1;
    float _e18 = received_1;
    float _e21 = low_2;
    float _e23 = received_1;
    float _e26 = high_1;
    float _e28 = low_2;
    float _e29 = high_1;
    return Several_f32_f32_f32_f32_(((0.5 * _e18) * _e21), ((0.5 * _e23) * _e26), _e28, _e29);
}

vec4 level_sky(int place, float share_1) {
    float e_1 = 0.0;
    float g = 0.0;
    int low_3 = 0;
    int high_2 = 0;
    e_1 = share_1;
    float _e6 = e_1;
    g = (1.0 - _e6);
    low_3 = (((place * 2) * 1) + 0);
    int _e15 = low_3;
    high_2 = (_e15 + 2);
    float _e18 = g;
    int _e19 = low_3;
    vec4 _e22 = read_sky((_e19 + 1));
    float _e24 = e_1;
    int _e25 = high_2;
    vec4 _e28 = read_sky((_e25 + 1));
    float _e31 = g;
    int _e32 = low_3;
    vec4 _e33 = read_sky(_e32);
    float _e35 = e_1;
    int _e36 = high_2;
    vec4 _e37 = read_sky(_e36);
    return (((_e18 * _e22) + (_e24 * _e28)) / ((_e31 * _e33) + (_e35 * _e37)));
}

vec4 reflected(vec4 received_2, vec4 albedo) {
    return ((received_2 * albedo) * 0.31830987);
}

void read_phase_here_1_(float half_sine, int nodes_1, int width) {
    float u_1 = 0.0;
    int node_2 = 0;
    float f_1 = 0.0;
    int at_2 = 0;
    vec4 low_4 = vec4(0.0);
    vec4 high_3 = vec4(0.0);
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
            low_4 = _e29;
            int _e30 = node_2;
            int _e34 = at_2;
            vec4 _e36 = read_phase((((_e30 + 1) * width) + _e34));
            high_3 = _e36;
            int _e38 = at_2;
            vec4 _e40 = low_4;
            float _e41 = f_1;
            vec4 _e42 = high_3;
            vec4 _e43 = low_4;
            air_texel_1_phase[_e38] = (_e40 + (_e41 * (_e42 - _e43)));
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
        air_texel_1_phase[(1 * int(_e24))] = vec4(0.0);
    }
    float _e34 = _group_0_binding_0_fs.peaks.z;
    if ((int(_e34) >= 0)) {
        float _e42 = _group_0_binding_0_fs.peaks.z;
        air_texel_1_phase[(1 * int(_e42))] = vec4(0.0);
        return;
    } else {
        return;
    }
}

int insert_edge_1_(int count, float cut) {
    int place_1 = 0;
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
    place_1 = count;
    while(true) {
        int _e24 = place_1;
        float _e28 = march_line_1_edges[(_e24 - 1)];
        if ((_e28 > cut)) {
        } else {
            break;
        }
        {
            int _e31 = place_1;
            int _e34 = place_1;
            float _e38 = march_line_1_edges[(_e34 - 1)];
            march_line_1_edges[_e31] = _e38;
            int _e39 = place_1;
            place_1 = (_e39 - 1);
        }
    }
    int _e43 = place_1;
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
    float x_17 = 0.0;
    float low_5 = 0.0;
    float high_4 = 0.0;
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
                    x_17 = (float(_e40) / 1.0);
                    int _e44 = leg;
                    if ((_e44 == 0)) {
                        float _e47 = end_1;
                        float _e48 = radius_along(r_10, mu_9, _e47);
                        low_5 = _e48;
                        float _e49 = start_1;
                        float _e50 = radius_along(r_10, mu_9, _e49);
                        high_4 = _e50;
                        float _e51 = low_5;
                        float _e52 = high_4;
                        float _e53 = low_5;
                        float _e55 = x_17;
                        float _e59 = x_17;
                        radius_5 = (_e51 + (((_e52 - _e53) * (1.0 - _e55)) * (1.0 - _e59)));
                        float _e64 = nearest_2;
                        float _e65 = radius_5;
                        float _e66 = chord(r_10, mu_9, _e65);
                        at_3 = (_e64 - _e66);
                    } else {
                        float _e68 = start_1;
                        float _e69 = radius_along(r_10, mu_9, _e68);
                        low_5 = _e69;
                        float _e70 = end_1;
                        float _e71 = radius_along(r_10, mu_9, _e70);
                        high_4 = _e71;
                        float _e72 = low_5;
                        float _e73 = high_4;
                        float _e74 = low_5;
                        float _e76 = x_17;
                        float _e78 = x_17;
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
    int k_2 = 0;
    float radius_6 = 0.0;
    float beside_2 = 0.0;
    count_2 = count_given;
    tangent_3 = (r_11 * sqrt(max(((1.0 - mu_10) * (1.0 + mu_10)), 0.0)));
    k_2 = 0;
    bool loop_init_3 = true;
    while(true) {
        if (!loop_init_3) {
            int _e43 = k_2;
            k_2 = (_e43 + 1);
        }
        loop_init_3 = false;
        int _e19 = k_2;
        int _e21 = size_ends(0);
        if ((_e19 < _e21)) {
        } else {
            break;
        }
        {
            int _e23 = k_2;
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
    float low_6 = 0.0;
    float beside_3 = 0.0;
    float first_3 = 0.0;
    float last_2 = 0.0;
    int k_3 = 0;
    float slope_1 = 0.0;
    int node_3 = 0;
    float share_2 = 0.0;
    int c_1 = 0;
    float here_1 = 0.0;
    float _e18 = read_rules(rule);
    n = int(_e18);
    Several_bool_f32_f32_f32_f32_ _e20 = panel_leg(r_12, mu_11, start_2, end_2, length_1_2);
    descending_2 = _e20.v0_;
    low_6 = _e20.v1_;
    beside_3 = _e20.v2_;
    first_3 = _e20.v3_;
    last_2 = _e20.v4_;
    k_3 = 0;
    bool loop_init_4 = true;
    while(true) {
        if (!loop_init_4) {
            int _e126 = k_3;
            k_3 = (_e126 + 1);
        }
        loop_init_4 = false;
        int _e27 = k_3;
        int _e28 = n;
        if ((_e27 < _e28)) {
        } else {
            break;
        }
        {
            bool _e32 = descending_2;
            float _e33 = low_6;
            float _e34 = beside_3;
            float _e35 = first_3;
            float _e36 = last_2;
            int _e39 = k_3;
            float _e41 = read_rules(((rule + 1) + _e39));
            Several_f32_f32_f32_ _e42 = panel_point((-(r_12) * mu_11), _e32, _e33, _e34, _e35, _e36, _e41);
            int _e44 = k_3;
            columns_along_1_distance_1_[_e44] = _e42.v0_;
            int _e48 = k_3;
            columns_along_1_radius[_e48] = _e42.v1_;
            slope_1 = _e42.v2_;
            int _e53 = k_3;
            float _e55 = slope_1;
            int _e58 = n;
            int _e60 = k_3;
            float _e62 = read_rules((((rule + 1) + _e58) + _e60));
            columns_along_1_weight[_e53] = (_e55 * _e62);
            int _e65 = k_3;
            float _e67 = columns_along_1_radius[_e65];
            float _e71 = _group_0_binding_0_fs.shell.x;
            float _e75 = _group_0_binding_0_fs.shell.y;
            float _e79 = _group_0_binding_0_fs.shell.x;
            int _e82 = size_density(0);
            Several_i32_f32_ _e83 = density_place(_e67, _e71, (_e75 - _e79), _e82);
            node_3 = _e83.v0_;
            share_2 = _e83.v1_;
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
                    int _e105 = k_3;
                    float _e108 = here_1;
                    int _e109 = node_3;
                    int _e113 = size_density(1);
                    int _e115 = c_1;
                    float _e117 = read_density((((_e109 + 1) * _e113) + _e115));
                    float _e118 = here_1;
                    float _e120 = share_2;
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
    int k_4 = 0;
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
            k_4 = 0;
            bool loop_init_8 = true;
            while(true) {
                if (!loop_init_8) {
                    int _e161 = k_4;
                    k_4 = (_e161 + 1);
                }
                loop_init_8 = false;
                int _e63 = k_4;
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
                            int _e79 = k_4;
                            float _e82 = columns_along_1_density[((_e76 * 24) + _e79)];
                            int _e84 = k_4;
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
                                    int _e139 = k_4;
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
                    float now_3_2 = depth_1;
                    int _e158 = k_4;
                    float now_4_1 = columns_along_1_distance_1_[_e158];
                    reached = now_3_2;
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
    float low_7 = 0.0;
    float beside_4 = 0.0;
    float first_4 = 0.0;
    float last_3 = 0.0;
    int k_5 = 0;
    float slope_2 = 0.0;
    int node_4 = 0;
    float share_3 = 0.0;
    int c_3 = 0;
    float here_2 = 0.0;
    float _e18 = read_rules(rule_2);
    n_2 = int(_e18);
    Several_bool_f32_f32_f32_f32_ _e20 = panel_leg(r_14, mu_13, start_3, end_3, length_1_3);
    descending_3 = _e20.v0_;
    low_7 = _e20.v1_;
    beside_4 = _e20.v2_;
    first_4 = _e20.v3_;
    last_3 = _e20.v4_;
    k_5 = 0;
    bool loop_init_11 = true;
    while(true) {
        if (!loop_init_11) {
            int _e126 = k_5;
            k_5 = (_e126 + 1);
        }
        loop_init_11 = false;
        int _e27 = k_5;
        int _e28 = n_2;
        if ((_e27 < _e28)) {
        } else {
            break;
        }
        {
            bool _e32 = descending_3;
            float _e33 = low_7;
            float _e34 = beside_4;
            float _e35 = first_4;
            float _e36 = last_3;
            int _e39 = k_5;
            float _e41 = read_rules(((rule_2 + 1) + _e39));
            Several_f32_f32_f32_ _e42 = panel_point((-(r_14) * mu_13), _e32, _e33, _e34, _e35, _e36, _e41);
            int _e44 = k_5;
            march_line_1_distance_1_[_e44] = _e42.v0_;
            int _e48 = k_5;
            march_line_1_radius[_e48] = _e42.v1_;
            slope_2 = _e42.v2_;
            int _e53 = k_5;
            float _e55 = slope_2;
            int _e58 = n_2;
            int _e60 = k_5;
            float _e62 = read_rules((((rule_2 + 1) + _e58) + _e60));
            march_line_1_weight[_e53] = (_e55 * _e62);
            int _e65 = k_5;
            float _e67 = march_line_1_radius[_e65];
            float _e71 = _group_0_binding_0_fs.shell.x;
            float _e75 = _group_0_binding_0_fs.shell.y;
            float _e79 = _group_0_binding_0_fs.shell.x;
            int _e82 = size_density(0);
            Several_i32_f32_ _e83 = density_place(_e67, _e71, (_e75 - _e79), _e82);
            node_4 = _e83.v0_;
            share_3 = _e83.v1_;
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
                    int _e105 = k_5;
                    float _e108 = here_2;
                    int _e109 = node_4;
                    int _e113 = size_density(1);
                    int _e115 = c_3;
                    float _e117 = read_density((((_e109 + 1) * _e113) + _e115));
                    float _e118 = here_2;
                    float _e120 = share_3;
                    march_line_1_density[((_e102 * 24) + _e105)] = (_e108 + ((_e117 - _e118) * _e120));
                }
            }
        }
    }
    return;
}

void panel_columns_1_(int rule_3) {
    int n_3 = 0;
    int k_6 = 0;
    int c_4 = 0;
    int j = 0;
    float share_4 = 0.0;
    float _e6 = read_rules(rule_3);
    n_3 = int(_e6);
    k_6 = 0;
    bool loop_init_13 = true;
    while(true) {
        if (!loop_init_13) {
            int _e121 = k_6;
            k_6 = (_e121 + 1);
        }
        loop_init_13 = false;
        int _e9 = k_6;
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
                    int _e24 = k_6;
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
                    int _e41 = k_6;
                    int _e42 = n_3;
                    int _e45 = j;
                    float _e47 = read_rules(((((rule_3 + 1) + (2 * _e37)) + (_e41 * _e42)) + _e45));
                    share_4 = _e47;
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
                            int _e60 = k_6;
                            int _e64 = c_4;
                            int _e67 = k_6;
                            float _e70 = march_line_1_columns[((_e64 * 24) + _e67)];
                            float _e71 = share_4;
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
                    int _e100 = k_6;
                    int _e104 = c_4;
                    float _e106 = march_line_1_before[_e104];
                    int _e108 = c_4;
                    int _e111 = k_6;
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
            k_6 = 0;
            bool loop_init_19 = true;
            while(true) {
                if (!loop_init_19) {
                    int _e152 = k_6;
                    k_6 = (_e152 + 1);
                }
                loop_init_19 = false;
                int _e133 = k_6;
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
                    int _e147 = k_6;
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

void columns_to_top_1_(float r_15, float mu_14, float bottom_4, float top_4) {
    float x_18 = 0.0;
    int row_3 = 0;
    float f_2 = 0.0;
    int place_2 = 0;
    float e_2 = 0.0;
    float w00_2 = 0.0;
    float w01_2 = 0.0;
    float w10_2 = 0.0;
    float w11_2 = 0.0;
    float distance_1_3 = 0.0;
    int c_6 = 0;
    float scale = 0.0;
    float scaled = 0.0;
    float _e17 = altitude_coordinate(r_15, bottom_4, top_4);
    int _e19 = size_columns(0);
    x_18 = (_e17 * float((_e19 - 1)));
    float _e24 = x_18;
    int _e27 = size_columns(0);
    row_3 = min(int(_e24), (_e27 - 2));
    float _e31 = x_18;
    int _e32 = row_3;
    f_2 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_15, mu_14, bottom_4, top_4);
    int _e37 = size_columns(1);
    x_18 = (_e35 * float((_e37 - 1)));
    float _e42 = x_18;
    int _e45 = size_columns(1);
    place_2 = min(int(_e42), (_e45 - 2));
    float _e49 = x_18;
    int _e50 = place_2;
    e_2 = (_e49 - float(_e50));
    float _e53 = f_2;
    float _e56 = e_2;
    float now_1_1 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_2;
    float _e63 = e_2;
    float now_2_2 = ((1.0 - _e60) * _e63);
    w00_2 = now_1_1;
    w01_2 = now_2_2;
    float _e65 = f_2;
    float _e66 = e_2;
    float now_3_3 = (_e65 * (1.0 - _e66));
    float _e70 = f_2;
    float _e71 = e_2;
    float now_4_2 = (_e70 * _e71);
    w10_2 = now_3_3;
    w11_2 = now_4_2;
    float _e73 = distance_to_top(r_15, mu_14, top_4);
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
            float _e79 = w00_2;
            int _e80 = row_3;
            int _e82 = size_columns(1);
            int _e84 = place_2;
            int _e87 = size_columns(2);
            int _e89 = c_6;
            int _e92 = size_columns(3);
            float _e96 = read_columns(((((((_e80 * _e82) + _e84) * _e87) + _e89) * _e92) + 0));
            float _e98 = w01_2;
            int _e99 = row_3;
            int _e101 = size_columns(1);
            int _e103 = place_2;
            int _e108 = size_columns(2);
            int _e110 = c_6;
            int _e113 = size_columns(3);
            float _e117 = read_columns(((((((_e99 * _e101) + (_e103 + 1)) * _e108) + _e110) * _e113) + 0));
            float _e120 = w10_2;
            int _e121 = row_3;
            int _e125 = size_columns(1);
            int _e127 = place_2;
            int _e130 = size_columns(2);
            int _e132 = c_6;
            int _e135 = size_columns(3);
            float _e139 = read_columns((((((((_e121 + 1) * _e125) + _e127) * _e130) + _e132) * _e135) + 0));
            float _e142 = w11_2;
            int _e143 = row_3;
            int _e147 = size_columns(1);
            int _e149 = place_2;
            int _e154 = size_columns(2);
            int _e156 = c_6;
            int _e159 = size_columns(3);
            float _e163 = read_columns((((((((_e143 + 1) * _e147) + (_e149 + 1)) * _e154) + _e156) * _e159) + 0));
            scale = ((((_e79 * _e96) + (_e98 * _e117)) + (_e120 * _e139)) + (_e142 * _e163));
            float _e166 = w00_2;
            int _e167 = row_3;
            int _e169 = size_columns(1);
            int _e171 = place_2;
            int _e174 = size_columns(2);
            int _e176 = c_6;
            int _e179 = size_columns(3);
            float _e183 = read_columns(((((((_e167 * _e169) + _e171) * _e174) + _e176) * _e179) + 1));
            float _e185 = w01_2;
            int _e186 = row_3;
            int _e188 = size_columns(1);
            int _e190 = place_2;
            int _e195 = size_columns(2);
            int _e197 = c_6;
            int _e200 = size_columns(3);
            float _e204 = read_columns(((((((_e186 * _e188) + (_e190 + 1)) * _e195) + _e197) * _e200) + 1));
            float _e207 = w10_2;
            int _e208 = row_3;
            int _e212 = size_columns(1);
            int _e214 = place_2;
            int _e217 = size_columns(2);
            int _e219 = c_6;
            int _e222 = size_columns(3);
            float _e226 = read_columns((((((((_e208 + 1) * _e212) + _e214) * _e217) + _e219) * _e222) + 1));
            float _e229 = w11_2;
            int _e230 = row_3;
            int _e234 = size_columns(1);
            int _e236 = place_2;
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

void columns_to_top_2_(float r_16, float mu_15, float bottom_5, float top_5) {
    float x_19 = 0.0;
    int row_4 = 0;
    float f_3 = 0.0;
    int place_3 = 0;
    float e_3 = 0.0;
    float w00_3 = 0.0;
    float w01_3 = 0.0;
    float w10_3 = 0.0;
    float w11_3 = 0.0;
    float distance_1_4 = 0.0;
    int c_7 = 0;
    float scale_1 = 0.0;
    float scaled_1 = 0.0;
    float _e17 = altitude_coordinate(r_16, bottom_5, top_5);
    int _e19 = size_columns(0);
    x_19 = (_e17 * float((_e19 - 1)));
    float _e24 = x_19;
    int _e27 = size_columns(0);
    row_4 = min(int(_e24), (_e27 - 2));
    float _e31 = x_19;
    int _e32 = row_4;
    f_3 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_16, mu_15, bottom_5, top_5);
    int _e37 = size_columns(1);
    x_19 = (_e35 * float((_e37 - 1)));
    float _e42 = x_19;
    int _e45 = size_columns(1);
    place_3 = min(int(_e42), (_e45 - 2));
    float _e49 = x_19;
    int _e50 = place_3;
    e_3 = (_e49 - float(_e50));
    float _e53 = f_3;
    float _e56 = e_3;
    float now_1_2 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_3;
    float _e63 = e_3;
    float now_2_3 = ((1.0 - _e60) * _e63);
    w00_3 = now_1_2;
    w01_3 = now_2_3;
    float _e65 = f_3;
    float _e66 = e_3;
    float now_3_4 = (_e65 * (1.0 - _e66));
    float _e70 = f_3;
    float _e71 = e_3;
    float now_4_3 = (_e70 * _e71);
    w10_3 = now_3_4;
    w11_3 = now_4_3;
    float _e73 = distance_to_top(r_16, mu_15, top_5);
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
            float _e79 = w00_3;
            int _e80 = row_4;
            int _e82 = size_columns(1);
            int _e84 = place_3;
            int _e87 = size_columns(2);
            int _e89 = c_7;
            int _e92 = size_columns(3);
            float _e96 = read_columns(((((((_e80 * _e82) + _e84) * _e87) + _e89) * _e92) + 0));
            float _e98 = w01_3;
            int _e99 = row_4;
            int _e101 = size_columns(1);
            int _e103 = place_3;
            int _e108 = size_columns(2);
            int _e110 = c_7;
            int _e113 = size_columns(3);
            float _e117 = read_columns(((((((_e99 * _e101) + (_e103 + 1)) * _e108) + _e110) * _e113) + 0));
            float _e120 = w10_3;
            int _e121 = row_4;
            int _e125 = size_columns(1);
            int _e127 = place_3;
            int _e130 = size_columns(2);
            int _e132 = c_7;
            int _e135 = size_columns(3);
            float _e139 = read_columns((((((((_e121 + 1) * _e125) + _e127) * _e130) + _e132) * _e135) + 0));
            float _e142 = w11_3;
            int _e143 = row_4;
            int _e147 = size_columns(1);
            int _e149 = place_3;
            int _e154 = size_columns(2);
            int _e156 = c_7;
            int _e159 = size_columns(3);
            float _e163 = read_columns((((((((_e143 + 1) * _e147) + (_e149 + 1)) * _e154) + _e156) * _e159) + 0));
            scale_1 = ((((_e79 * _e96) + (_e98 * _e117)) + (_e120 * _e139)) + (_e142 * _e163));
            float _e166 = w00_3;
            int _e167 = row_4;
            int _e169 = size_columns(1);
            int _e171 = place_3;
            int _e174 = size_columns(2);
            int _e176 = c_7;
            int _e179 = size_columns(3);
            float _e183 = read_columns(((((((_e167 * _e169) + _e171) * _e174) + _e176) * _e179) + 1));
            float _e185 = w01_3;
            int _e186 = row_4;
            int _e188 = size_columns(1);
            int _e190 = place_3;
            int _e195 = size_columns(2);
            int _e197 = c_7;
            int _e200 = size_columns(3);
            float _e204 = read_columns(((((((_e186 * _e188) + (_e190 + 1)) * _e195) + _e197) * _e200) + 1));
            float _e207 = w10_3;
            int _e208 = row_4;
            int _e212 = size_columns(1);
            int _e214 = place_3;
            int _e217 = size_columns(2);
            int _e219 = c_7;
            int _e222 = size_columns(3);
            float _e226 = read_columns((((((((_e208 + 1) * _e212) + _e214) * _e217) + _e219) * _e222) + 1));
            float _e229 = w11_3;
            int _e230 = row_4;
            int _e234 = size_columns(1);
            int _e236 = place_3;
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

vec4 scattered_star_1_(int constituents_4) {
    vec4 source = vec4(0.0);
    int c_10 = 0;
    source = vec4(0.0);
    c_10 = 0;
    bool loop_init_25 = true;
    while(true) {
        if (!loop_init_25) {
            int _e30 = c_10;
            c_10 = (_e30 + 1);
        }
        loop_init_25 = false;
        int _e6 = c_10;
        if ((_e6 < constituents_4)) {
        } else {
            break;
        }
        {
            vec4 _e8 = source;
            int _e9 = c_10;
            vec4 _e14 = read_scattering(((1 * _e9) + 0));
            int _e16 = c_10;
            vec4 _e22 = air_texel_1_phase[((1 * _e16) + 0)];
            int _e25 = c_10;
            float _e27 = march_line_1_rho[_e25];
            source = (_e8 + ((_e14 * _e22) * _e27));
        }
    }
    vec4 _e33 = source;
    return _e33;
}

void legendre_functions_1_(float mu_16) {
    int degree = 0;
    float sine_1_4 = 0.0;
    float power = 0.0;
    int m = 0;
    float before = 0.0;
    float value = 0.0;
    int index_20 = 0;
    int l = 0;
    float following = 0.0;
    float _e13 = _group_0_binding_0_fs.counts.y;
    degree = int(_e13);
    sine_1_4 = sqrt(max(((1.0 - mu_16) * (1.0 + mu_16)), 0.0));
    power = 1.0;
    m = 0;
    bool loop_init_26 = true;
    while(true) {
        if (!loop_init_26) {
            int _e81 = m;
            m = (_e81 + 1);
        }
        loop_init_26 = false;
        int _e25 = m;
        int _e26 = degree;
        if ((_e25 < (_e26 + 1))) {
        } else {
            break;
        }
        {
            before = 0.0;
            int _e31 = m;
            float _e32 = read_start(_e31);
            float _e33 = power;
            value = (_e32 * _e33);
            int _e35 = m;
            int _e36 = m;
            int _e42 = m;
            index_20 = (((_e35 * (_e36 + 1)) / 2) + _e42);
            int _e45 = index_20;
            float _e47 = value;
            march_line_1_functions[_e45] = _e47;
            int _e48 = m;
            l = (_e48 + 1);
            bool loop_init_27 = true;
            while(true) {
                if (!loop_init_27) {
                    int _e75 = l;
                    l = (_e75 + 1);
                }
                loop_init_27 = false;
                int _e51 = l;
                int _e52 = degree;
                if ((_e51 < (_e52 + 1))) {
                } else {
                    break;
                }
                {
                    int _e56 = index_20;
                    int _e57 = l;
                    index_20 = (_e56 + _e57);
                    int _e59 = index_20;
                    float _e60 = read_ahead(_e59);
                    float _e62 = value;
                    int _e64 = index_20;
                    float _e65 = read_back(_e64);
                    float _e66 = before;
                    following = (((_e60 * mu_16) * _e62) - (_e65 * _e66));
                    float _e69 = value;
                    before = _e69;
                    float _e70 = following;
                    value = _e70;
                    int _e72 = index_20;
                    float _e74 = value;
                    march_line_1_functions[_e72] = _e74;
                }
            }
            float _e78 = power;
            float _e79 = sine_1_4;
            power = (_e78 * _e79);
        }
    }
    return;
}

void times_cosines_1_(float step_1_, int degree_1) {
    float before_1 = 0.0;
    float multiple = 0.0;
    int m_1 = 0;
    int index_21 = 0;
    int l_1 = 0;
    before_1 = 1.0;
    multiple = step_1_;
    m_1 = 1;
    bool loop_init_28 = true;
    while(true) {
        if (!loop_init_28) {
            int _e51 = m_1;
            m_1 = (_e51 + 1);
        }
        loop_init_28 = false;
        int _e9 = m_1;
        if ((_e9 < (degree_1 + 1))) {
        } else {
            break;
        }
        {
            int _e13 = m_1;
            int _e14 = m_1;
            int _e20 = m_1;
            index_21 = (((_e13 * (_e14 + 1)) / 2) + _e20);
            int _e22 = m_1;
            l_1 = _e22;
            bool loop_init_29 = true;
            while(true) {
                if (!loop_init_29) {
                    int _e41 = l_1;
                    l_1 = (_e41 + 1);
                }
                loop_init_29 = false;
                int _e23 = l_1;
                if ((_e23 < (degree_1 + 1))) {
                } else {
                    break;
                }
                {
                    int _e28 = index_21;
                    int _e31 = index_21;
                    float _e33 = march_line_1_functions[_e31];
                    float _e34 = multiple;
                    march_line_1_functions[_e28] = (_e33 * _e34);
                    int _e36 = index_21;
                    int _e37 = l_1;
                    index_21 = (_e36 + (_e37 + 1));
                }
            }
            float now_3_5 = multiple;
            float _e47 = multiple;
            float _e49 = before_1;
            float now_4_4 = (((2.0 * step_1_) * _e47) - _e49);
            before_1 = now_3_5;
            multiple = now_4_4;
        }
    }
    return;
}

vec4 gathered_light_1_(int near_1, int far_1, int block_1, float w00_4, float w01_4, float w10_4, float w11_4, int degree_2, int constituents_5) {
    vec4 gathered = vec4(0.0);
    int l_2 = 0;
    vec4 strength = vec4(0.0);
    int c_11 = 0;
    vec4 part_1 = vec4(0.0);
    int index_22 = 0;
    int here_3 = 0;
    vec4 scale_2 = vec4(0.0);
    gathered = vec4(0.0);
    l_2 = 0;
    bool loop_init_30 = true;
    while(true) {
        if (!loop_init_30) {
            int _e97 = l_2;
            l_2 = (_e97 + 1);
        }
        loop_init_30 = false;
        int _e20 = l_2;
        if ((_e20 < (degree_2 + 1))) {
        } else {
            break;
        }
        {
            strength = vec4(0.0);
            c_11 = 0;
            bool loop_init_31 = true;
            while(true) {
                if (!loop_init_31) {
                    int _e47 = c_11;
                    c_11 = (_e47 + 1);
                }
                loop_init_31 = false;
                int _e27 = c_11;
                if ((_e27 < constituents_5)) {
                } else {
                    break;
                }
                {
                    vec4 _e29 = strength;
                    int _e30 = c_11;
                    int _e34 = l_2;
                    vec4 _e40 = read_moments(((1 * ((_e30 * (degree_2 + 1)) + _e34)) + 0));
                    int _e42 = c_11;
                    float _e44 = march_line_1_rho[_e42];
                    strength = (_e29 + (_e40 * _e44));
                }
            }
            part_1 = vec4(0.0);
            int _e52 = l_2;
            int _e53 = l_2;
            index_22 = ((_e52 * (_e53 + 1)) / 2);
            bool loop_init_32 = true;
            while(true) {
                if (!loop_init_32) {
                    int _e89 = index_22;
                    index_22 = (_e89 + 1);
                }
                loop_init_32 = false;
                int _e59 = index_22;
                int _e60 = l_2;
                int _e63 = l_2;
                if ((_e59 < (((_e60 + 1) * (_e63 + 2)) / 2))) {
                } else {
                    break;
                }
                {
                    int _e70 = index_22;
                    here_3 = ((1 * (1 + _e70)) + 0);
                    vec4 _e77 = part_1;
                    int _e79 = index_22;
                    float _e81 = march_line_1_functions[_e79];
                    int _e82 = here_3;
                    int _e84 = here_3;
                    vec4 _e86 = between((near_1 + _e82), (far_1 + _e84), block_1, w00_4, w01_4, w10_4, w11_4);
                    part_1 = (_e77 + (_e81 * _e86));
                }
            }
            vec4 _e92 = gathered;
            vec4 _e93 = strength;
            vec4 _e94 = part_1;
            gathered = (_e92 + (_e93 * _e94));
        }
    }
    vec4 _e104 = between((near_1 + 0), (far_1 + 0), block_1, w00_4, w01_4, w10_4, w11_4);
    scale_2 = _e104;
    vec4 _e105 = gathered;
    vec4 _e106 = scale_2;
    return max((_e105 / _e106), vec4(0.0));
}

vec4 through_columns_2_(int constituents_6) {
    vec4 tau_3 = vec4(0.0);
    int c_12 = 0;
    tau_3 = vec4(0.0);
    c_12 = 0;
    bool loop_init_33 = true;
    while(true) {
        if (!loop_init_33) {
            int _e21 = c_12;
            c_12 = (_e21 + 1);
        }
        loop_init_33 = false;
        int _e6 = c_12;
        if ((_e6 < constituents_6)) {
        } else {
            break;
        }
        {
            vec4 _e8 = tau_3;
            int _e9 = c_12;
            vec4 _e14 = read_extinction(((1 * _e9) + 0));
            int _e16 = c_12;
            float _e18 = march_line_1_before[_e16];
            tau_3 = (_e8 + (_e14 * _e18));
        }
    }
    vec4 _e24 = tau_3;
    return exp((vec4(0.0) - _e24));
}

void march_line_1_(float r_17, float mu_17, float mu_s_7, float nu_2, float length_1_4, int orders) {
    float bottom_6 = 0.0;
    float top_6 = 0.0;
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
    int c_13 = 0;
    float faint = 0.0;
    vec4 air = vec4(0.0);
    vec4 first_5 = vec4(0.0);
    vec4 second_1 = vec4(0.0);
    int block_2 = 0;
    int panel_1 = 0;
    int k_7 = 0;
    float q_1 = 0.0;
    float t = 0.0;
    float mu_q = 0.0;
    float mu_sq = 0.0;
    float nu_q = 0.0;
    float depth_2 = 0.0;
    float angle_2 = 0.0;
    vec4 through = vec4(0.0);
    float seen_2 = 0.0;
    float low_8 = 0.0;
    float high_5 = 0.0;
    vec4 star = vec4(0.0);
    float spread_1 = 0.0;
    float step_1_1 = 0.0;
    float x_20 = 0.0;
    int row_5 = 0;
    float f_4 = 0.0;
    int place_4 = 0;
    float e_4 = 0.0;
    float g_1 = 0.0;
    float h = 0.0;
    int near_2 = 0;
    bool local_6 = false;
    bool local_7 = false;
    float now_1_3 = _group_0_binding_0_fs.shell.x;
    float now_2_4 = _group_0_binding_0_fs.shell.y;
    bottom_6 = now_1_3;
    top_6 = now_2_4;
    float _e58 = bottom_6;
    Several_f32_f32_ _e59 = shadow_edges(r_17, mu_17, mu_s_7, nu_2, _e58);
    first_cut_1 = _e59.v0_;
    second_cut_1 = _e59.v1_;
    float _e62 = first_cut_1;
    float _e63 = second_cut_1;
    int _e64 = place_edges_1_(r_17, mu_17, length_1_4, _e62, _e63);
    count_4 = _e64;
    float _e65 = bottom_6;
    int _e66 = count_4;
    int _e67 = cut_at_corners_1_(r_17, mu_17, _e65, _e66);
    count_4 = _e67;
    float _e71 = radius_along(r_17, mu_17, length_1_4);
    end_4 = min(mu_s_7, (((r_17 * mu_s_7) + (length_1_4 * nu_2)) / _e71));
    float _e74 = top_6;
    float _e75 = bottom_6;
    slant = (length_1_4 / (_e74 - _e75));
    float _e78 = end_4;
    day = (_e78 > 0.1);
    float _e81 = slant;
    kind = ((_e81 < 9.0) ? 1 : 2);
    bool _e87 = day;
    if (_e87) {
        float _e90 = slant;
        local_6 = (_e90 < 4.0);
    } else {
        local_6 = false;
    }
    bool _e94 = local_6;
    if (_e94) {
        kind = 0;
    }
    int _e96 = kind;
    float _e97 = read_rules(_e96);
    rule_4 = int(_e97);
    int _e99 = rule_4;
    float _e100 = read_rules(_e99);
    n_4 = int(_e100);
    attempt = 0;
    bool loop_init_34 = true;
    while(true) {
        if (!loop_init_34) {
            int _e124 = attempt;
            attempt = (_e124 + 1);
        }
        loop_init_34 = false;
        int _e103 = attempt;
        if ((_e103 < 2)) {
        } else {
            break;
        }
        {
            int _e106 = count_4;
            int _e107 = rule_4;
            float _e108 = columns_along_1_(r_17, mu_17, _e106, _e107);
            if ((_e108 <= 15.0)) {
                break;
            }
            which_1 = 0;
            bool loop_init_35 = true;
            while(true) {
                if (!loop_init_35) {
                    int _e121 = which_1;
                    which_1 = (_e121 + 1);
                }
                loop_init_35 = false;
                int _e112 = which_1;
                if ((_e112 < 3)) {
                } else {
                    break;
                }
                {
                    int _e115 = count_4;
                    int _e117 = which_1;
                    float _e119 = march_line_1_cuts[_e117];
                    int _e120 = insert_edge_1_(_e115, _e119);
                    count_4 = _e120;
                }
            }
        }
    }
    scatters = 0.0;
    c_13 = 0;
    bool loop_init_36 = true;
    while(true) {
        if (!loop_init_36) {
            int _e149 = c_13;
            c_13 = (_e149 + 1);
        }
        loop_init_36 = false;
        int _e129 = c_13;
        float _e133 = _group_0_binding_0_fs.counts.x;
        if ((_e129 < int(_e133))) {
        } else {
            break;
        }
        {
            float _e136 = scatters;
            int _e137 = c_13;
            float _e138 = read_brightest(_e137);
            int _e140 = c_13;
            float _e142 = look_1_totals[_e140];
            scatters = (_e136 + (_e138 * _e142));
            int _e146 = c_13;
            march_line_1_before[_e146] = 0.0;
        }
    }
    float _e152 = scatters;
    bool _e157 = day;
    faint = (_e157 ? (0.0005 * min(_e152, 1.0)) : 0.0);
    vec4 now_4_5 = vec4(0.0);
    vec4 now_5_ = vec4(0.0);
    vec4 now_6_ = vec4(0.0);
    air = now_4_5;
    first_5 = now_5_;
    second_1 = now_6_;
    float _e169 = _group_0_binding_0_fs.counts.y;
    float _e176 = _group_0_binding_0_fs.counts.y;
    block_2 = (1 * (1 + (((int(_e169) + 1) * (int(_e176) + 2)) / 2)));
    panel_1 = 0;
    bool loop_init_37 = true;
    while(true) {
        if (!loop_init_37) {
            int _e562 = panel_1;
            panel_1 = (_e562 + 1);
        }
        loop_init_37 = false;
        int _e188 = panel_1;
        int _e189 = count_4;
        if ((_e188 < (_e189 - 1))) {
        } else {
            break;
        }
        {
            int _e194 = panel_1;
            float _e196 = march_line_1_edges[_e194];
            int _e198 = panel_1;
            float _e202 = march_line_1_edges[(_e198 + 1)];
            int _e204 = count_4;
            float _e208 = march_line_1_edges[(_e204 - 1)];
            int _e209 = rule_4;
            place_panel_1_(r_17, mu_17, _e196, _e202, _e208, _e209);
            c_13 = 0;
            bool loop_init_38 = true;
            while(true) {
                if (!loop_init_38) {
                    int _e245 = c_13;
                    c_13 = (_e245 + 1);
                }
                loop_init_38 = false;
                int _e211 = c_13;
                float _e215 = _group_0_binding_0_fs.counts.x;
                if ((_e211 < int(_e215))) {
                } else {
                    break;
                }
                {
                    k_7 = 0;
                    bool loop_init_39 = true;
                    while(true) {
                        if (!loop_init_39) {
                            int _e242 = k_7;
                            k_7 = (_e242 + 1);
                        }
                        loop_init_39 = false;
                        int _e219 = k_7;
                        int _e220 = n_4;
                        if ((_e219 < _e220)) {
                        } else {
                            break;
                        }
                        {
                            int _e223 = c_13;
                            int _e226 = k_7;
                            int _e230 = c_13;
                            int _e233 = k_7;
                            float _e236 = march_line_1_density[((_e230 * 24) + _e233)];
                            int _e238 = k_7;
                            float _e240 = march_line_1_weight[_e238];
                            march_line_1_amounts[((_e223 * 24) + _e226)] = (_e236 * _e240);
                        }
                    }
                }
            }
            int _e248 = rule_4;
            panel_columns_1_(_e248);
            k_7 = 0;
            bool loop_init_40 = true;
            while(true) {
                if (!loop_init_40) {
                    int _e559 = k_7;
                    k_7 = (_e559 + 1);
                }
                loop_init_40 = false;
                int _e250 = k_7;
                int _e251 = n_4;
                if ((_e250 < _e251)) {
                } else {
                    break;
                }
                {
                    int _e254 = k_7;
                    float _e256 = march_line_1_radius[_e254];
                    float _e257 = bottom_6;
                    float _e259 = top_6;
                    q_1 = min(max(_e256, _e257), _e259);
                    int _e262 = k_7;
                    float _e264 = march_line_1_distance_1_[_e262];
                    t = _e264;
                    float _e266 = t;
                    float _e268 = q_1;
                    mu_q = min(max((((r_17 * mu_17) + _e266) / _e268), -1.0), 1.0);
                    float _e275 = t;
                    float _e278 = q_1;
                    mu_sq = min(max((((r_17 * mu_s_7) + (_e275 * nu_2)) / _e278), -1.0), 1.0);
                    nu_q = nu_2;
                    depth_2 = 0.0;
                    c_13 = 0;
                    bool loop_init_41 = true;
                    while(true) {
                        if (!loop_init_41) {
                            int _e324 = c_13;
                            c_13 = (_e324 + 1);
                        }
                        loop_init_41 = false;
                        int _e286 = c_13;
                        float _e290 = _group_0_binding_0_fs.counts.x;
                        if ((_e286 < int(_e290))) {
                        } else {
                            break;
                        }
                        {
                            int _e294 = c_13;
                            int _e297 = c_13;
                            int _e300 = k_7;
                            float _e303 = march_line_1_density[((_e297 * 24) + _e300)];
                            march_line_1_rho[_e294] = _e303;
                            int _e305 = c_13;
                            int _e308 = c_13;
                            int _e311 = k_7;
                            float _e314 = march_line_1_columns[((_e308 * 24) + _e311)];
                            march_line_1_depths[_e305] = _e314;
                            float _e315 = depth_2;
                            int _e316 = c_13;
                            float _e317 = read_brightest(_e316);
                            int _e319 = c_13;
                            float _e321 = march_line_1_rho[_e319];
                            depth_2 = (_e315 + (_e317 * _e321));
                        }
                    }
                    float _e330 = _group_0_binding_0_fs.shell.w;
                    if ((_e330 > 0.0)) {
                        float _e336 = _group_0_binding_0_fs.shell.w;
                        float _e341 = _group_0_binding_0_fs.counts.x;
                        float _e346 = march_line_1_depths[(int(_e341) - 1)];
                        float _e347 = bend_angle(r_17, mu_17, _e336, _e346);
                        angle_2 = _e347;
                        float _e348 = mu_q;
                        float _e349 = mu_sq;
                        float _e350 = angle_2;
                        Several_f32_f32_ _e351 = turned(_e348, _e349, nu_2, _e350);
                        mu_sq = _e351.v0_;
                        nu_q = _e351.v1_;
                        float _e354 = mu_sq;
                        mu_sq = min(max(_e354, -1.0), 1.0);
                    }
                    float _e362 = _group_0_binding_0_fs.counts.x;
                    vec4 _e364 = through_columns_1_(int(_e362));
                    int _e366 = k_7;
                    float _e368 = march_line_1_weight[_e366];
                    through = (_e364 * _e368);
                    if ((orders != 0)) {
                        float _e372 = q_1;
                        float _e373 = mu_sq;
                        float _e374 = bottom_6;
                        float _e375 = top_6;
                        float _e379 = _group_0_binding_0_fs.shell.z;
                        Several_f32_f32_f32_ _e380 = star_points(_e372, _e373, _e374, _e375, _e379);
                        seen_2 = _e380.v0_;
                        low_8 = _e380.v1_;
                        high_5 = _e380.v2_;
                        float _e384 = seen_2;
                        if ((_e384 > 0.0)) {
                            float _e387 = q_1;
                            float _e388 = low_8;
                            float _e389 = bottom_6;
                            float _e390 = top_6;
                            columns_to_top_1_(_e387, _e388, _e389, _e390);
                            float _e391 = high_5;
                            float _e392 = low_8;
                            if ((_e391 > _e392)) {
                                float _e394 = q_1;
                                float _e395 = high_5;
                                float _e396 = bottom_6;
                                float _e397 = top_6;
                                columns_to_top_2_(_e394, _e395, _e396, _e397);
                            }
                            vec4 _e398 = through;
                            float _e399 = seen_2;
                            float _e400 = high_5;
                            float _e401 = low_8;
                            float _e406 = _group_0_binding_0_fs.counts.x;
                            vec4 _e408 = star_at_1_(_e399, (_e400 > _e401), int(_e406));
                            star = (_e398 * _e408);
                            vec4 _e410 = air;
                            vec4 _e411 = star;
                            float _e415 = _group_0_binding_0_fs.counts.x;
                            vec4 _e417 = scattered_star_1_(int(_e415));
                            air = (_e410 + (_e411 * _e417));
                        }
                    }
                    if ((orders != 1)) {
                        float _e424 = depth_2;
                        int _e426 = k_7;
                        float _e428 = march_line_1_weight[_e426];
                        float _e430 = faint;
                        local_7 = ((_e424 * _e428) >= _e430);
                    } else {
                        local_7 = false;
                    }
                    bool _e433 = local_7;
                    if (_e433) {
                        float _e434 = mu_q;
                        legendre_functions_1_(_e434);
                        float _e435 = mu_q;
                        float _e438 = mu_q;
                        float _e442 = mu_sq;
                        float _e446 = mu_sq;
                        spread_1 = ((((1.0 - _e435) * (1.0 + _e438)) * (1.0 - _e442)) * (1.0 + _e446));
                        float _e450 = nu_q;
                        float _e451 = mu_q;
                        float _e452 = mu_sq;
                        float _e455 = spread_1;
                        step_1_1 = ((_e450 - (_e451 * _e452)) / sqrt(max(_e455, 1e-24)));
                        float _e460 = step_1_1;
                        float _e468 = _group_0_binding_0_fs.counts.y;
                        times_cosines_1_(min(max(_e460, -1.0), 1.0), int(_e468));
                        float _e470 = q_1;
                        float _e471 = bottom_6;
                        float _e472 = top_6;
                        float _e473 = row_of(_e470, _e471, _e472);
                        x_20 = _e473;
                        float _e474 = x_20;
                        float _e479 = _group_0_binding_0_fs.counts.z;
                        row_5 = min(int(_e474), (int(_e479) - 2));
                        float _e484 = x_20;
                        int _e485 = row_5;
                        f_4 = (_e484 - float(_e485));
                        float _e488 = mu_sq;
                        float _e489 = place_of(_e488);
                        x_20 = _e489;
                        float _e490 = x_20;
                        float _e495 = _group_0_binding_0_fs.counts.w;
                        place_4 = min(int(_e490), (int(_e495) - 2));
                        float _e500 = x_20;
                        int _e501 = place_4;
                        e_4 = (_e500 - float(_e501));
                        float _e504 = f_4;
                        g_1 = (1.0 - _e504);
                        float _e507 = e_4;
                        h = (1.0 - _e507);
                        int _e510 = row_5;
                        float _e514 = _group_0_binding_0_fs.counts.w;
                        int _e517 = place_4;
                        int _e519 = block_2;
                        near_2 = (((_e510 * int(_e514)) + _e517) * _e519);
                        vec4 _e521 = air;
                        vec4 _e522 = through;
                        int _e523 = near_2;
                        int _e524 = near_2;
                        float _e528 = _group_0_binding_0_fs.counts.w;
                        int _e530 = block_2;
                        int _e533 = block_2;
                        float _e534 = g_1;
                        float _e535 = h;
                        float _e537 = g_1;
                        float _e538 = e_4;
                        float _e540 = f_4;
                        float _e541 = h;
                        float _e543 = f_4;
                        float _e544 = e_4;
                        float _e549 = _group_0_binding_0_fs.counts.y;
                        float _e554 = _group_0_binding_0_fs.counts.x;
                        vec4 _e556 = gathered_light_1_(_e523, (_e524 + (int(_e528) * _e530)), _e533, (_e534 * _e535), (_e537 * _e538), (_e540 * _e541), (_e543 * _e544), int(_e549), int(_e554));
                        air = (_e521 + (_e522 * _e556));
                    }
                }
            }
        }
    }
    c_13 = 0;
    bool loop_init_42 = true;
    while(true) {
        if (!loop_init_42) {
            int _e580 = c_13;
            c_13 = (_e580 + 1);
        }
        loop_init_42 = false;
        int _e566 = c_13;
        float _e570 = _group_0_binding_0_fs.counts.x;
        if ((_e566 < int(_e570))) {
        } else {
            break;
        }
        {
            int _e574 = c_13;
            int _e577 = c_13;
            float _e579 = march_line_1_before[_e577];
            look_1_totals[_e574] = _e579;
        }
    }
    vec4 _e585 = air;
    look_1_along[0] = _e585;
    float _e591 = _group_0_binding_0_fs.counts.x;
    vec4 _e593 = through_columns_2_(int(_e591));
    look_1_along[1] = _e593;
    vec4 _e596 = first_5;
    look_1_along[2] = _e596;
    vec4 _e599 = second_1;
    look_1_along[3] = _e599;
    return;
}

void columns_to_top_3_(float r_18, float mu_18, float bottom_7, float top_7) {
    float x_21 = 0.0;
    int row_6 = 0;
    float f_5 = 0.0;
    int place_5 = 0;
    float e_5 = 0.0;
    float w00_5 = 0.0;
    float w01_5 = 0.0;
    float w10_5 = 0.0;
    float w11_5 = 0.0;
    float distance_1_5 = 0.0;
    int c_14 = 0;
    float scale_3 = 0.0;
    float scaled_2 = 0.0;
    float _e17 = altitude_coordinate(r_18, bottom_7, top_7);
    int _e19 = size_columns(0);
    x_21 = (_e17 * float((_e19 - 1)));
    float _e24 = x_21;
    int _e27 = size_columns(0);
    row_6 = min(int(_e24), (_e27 - 2));
    float _e31 = x_21;
    int _e32 = row_6;
    f_5 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_18, mu_18, bottom_7, top_7);
    int _e37 = size_columns(1);
    x_21 = (_e35 * float((_e37 - 1)));
    float _e42 = x_21;
    int _e45 = size_columns(1);
    place_5 = min(int(_e42), (_e45 - 2));
    float _e49 = x_21;
    int _e50 = place_5;
    e_5 = (_e49 - float(_e50));
    float _e53 = f_5;
    float _e56 = e_5;
    float now_1_4 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_5;
    float _e63 = e_5;
    float now_2_5 = ((1.0 - _e60) * _e63);
    w00_5 = now_1_4;
    w01_5 = now_2_5;
    float _e65 = f_5;
    float _e66 = e_5;
    float now_3_6 = (_e65 * (1.0 - _e66));
    float _e70 = f_5;
    float _e71 = e_5;
    float now_4_6 = (_e70 * _e71);
    w10_5 = now_3_6;
    w11_5 = now_4_6;
    float _e73 = distance_to_top(r_18, mu_18, top_7);
    distance_1_5 = _e73;
    c_14 = 0;
    bool loop_init_43 = true;
    while(true) {
        if (!loop_init_43) {
            int _e261 = c_14;
            c_14 = (_e261 + 1);
        }
        loop_init_43 = false;
        int _e75 = c_14;
        int _e77 = size_columns(2);
        if ((_e75 < _e77)) {
        } else {
            break;
        }
        {
            float _e79 = w00_5;
            int _e80 = row_6;
            int _e82 = size_columns(1);
            int _e84 = place_5;
            int _e87 = size_columns(2);
            int _e89 = c_14;
            int _e92 = size_columns(3);
            float _e96 = read_columns(((((((_e80 * _e82) + _e84) * _e87) + _e89) * _e92) + 0));
            float _e98 = w01_5;
            int _e99 = row_6;
            int _e101 = size_columns(1);
            int _e103 = place_5;
            int _e108 = size_columns(2);
            int _e110 = c_14;
            int _e113 = size_columns(3);
            float _e117 = read_columns(((((((_e99 * _e101) + (_e103 + 1)) * _e108) + _e110) * _e113) + 0));
            float _e120 = w10_5;
            int _e121 = row_6;
            int _e125 = size_columns(1);
            int _e127 = place_5;
            int _e130 = size_columns(2);
            int _e132 = c_14;
            int _e135 = size_columns(3);
            float _e139 = read_columns((((((((_e121 + 1) * _e125) + _e127) * _e130) + _e132) * _e135) + 0));
            float _e142 = w11_5;
            int _e143 = row_6;
            int _e147 = size_columns(1);
            int _e149 = place_5;
            int _e154 = size_columns(2);
            int _e156 = c_14;
            int _e159 = size_columns(3);
            float _e163 = read_columns((((((((_e143 + 1) * _e147) + (_e149 + 1)) * _e154) + _e156) * _e159) + 0));
            scale_3 = ((((_e79 * _e96) + (_e98 * _e117)) + (_e120 * _e139)) + (_e142 * _e163));
            float _e166 = w00_5;
            int _e167 = row_6;
            int _e169 = size_columns(1);
            int _e171 = place_5;
            int _e174 = size_columns(2);
            int _e176 = c_14;
            int _e179 = size_columns(3);
            float _e183 = read_columns(((((((_e167 * _e169) + _e171) * _e174) + _e176) * _e179) + 1));
            float _e185 = w01_5;
            int _e186 = row_6;
            int _e188 = size_columns(1);
            int _e190 = place_5;
            int _e195 = size_columns(2);
            int _e197 = c_14;
            int _e200 = size_columns(3);
            float _e204 = read_columns(((((((_e186 * _e188) + (_e190 + 1)) * _e195) + _e197) * _e200) + 1));
            float _e207 = w10_5;
            int _e208 = row_6;
            int _e212 = size_columns(1);
            int _e214 = place_5;
            int _e217 = size_columns(2);
            int _e219 = c_14;
            int _e222 = size_columns(3);
            float _e226 = read_columns((((((((_e208 + 1) * _e212) + _e214) * _e217) + _e219) * _e222) + 1));
            float _e229 = w11_5;
            int _e230 = row_6;
            int _e234 = size_columns(1);
            int _e236 = place_5;
            int _e241 = size_columns(2);
            int _e243 = c_14;
            int _e246 = size_columns(3);
            float _e250 = read_columns((((((((_e230 + 1) * _e234) + (_e236 + 1)) * _e241) + _e243) * _e246) + 1));
            scaled_2 = ((((_e166 * _e183) + (_e185 * _e204)) + (_e207 * _e226)) + (_e229 * _e250));
            int _e254 = c_14;
            float _e256 = distance_1_5;
            float _e257 = scaled_2;
            float _e259 = scale_3;
            ground_received_1_below[_e254] = ((_e256 * _e257) / _e259);
        }
    }
    return;
}

void columns_to_top_4_(float r_19, float mu_19, float bottom_8, float top_8) {
    float x_22 = 0.0;
    int row_7 = 0;
    float f_6 = 0.0;
    int place_6 = 0;
    float e_6 = 0.0;
    float w00_6 = 0.0;
    float w01_6 = 0.0;
    float w10_6 = 0.0;
    float w11_6 = 0.0;
    float distance_1_6 = 0.0;
    int c_15 = 0;
    float scale_4 = 0.0;
    float scaled_3 = 0.0;
    float _e17 = altitude_coordinate(r_19, bottom_8, top_8);
    int _e19 = size_columns(0);
    x_22 = (_e17 * float((_e19 - 1)));
    float _e24 = x_22;
    int _e27 = size_columns(0);
    row_7 = min(int(_e24), (_e27 - 2));
    float _e31 = x_22;
    int _e32 = row_7;
    f_6 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_19, mu_19, bottom_8, top_8);
    int _e37 = size_columns(1);
    x_22 = (_e35 * float((_e37 - 1)));
    float _e42 = x_22;
    int _e45 = size_columns(1);
    place_6 = min(int(_e42), (_e45 - 2));
    float _e49 = x_22;
    int _e50 = place_6;
    e_6 = (_e49 - float(_e50));
    float _e53 = f_6;
    float _e56 = e_6;
    float now_1_5 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_6;
    float _e63 = e_6;
    float now_2_6 = ((1.0 - _e60) * _e63);
    w00_6 = now_1_5;
    w01_6 = now_2_6;
    float _e65 = f_6;
    float _e66 = e_6;
    float now_3_7 = (_e65 * (1.0 - _e66));
    float _e70 = f_6;
    float _e71 = e_6;
    float now_4_7 = (_e70 * _e71);
    w10_6 = now_3_7;
    w11_6 = now_4_7;
    float _e73 = distance_to_top(r_19, mu_19, top_8);
    distance_1_6 = _e73;
    c_15 = 0;
    bool loop_init_44 = true;
    while(true) {
        if (!loop_init_44) {
            int _e261 = c_15;
            c_15 = (_e261 + 1);
        }
        loop_init_44 = false;
        int _e75 = c_15;
        int _e77 = size_columns(2);
        if ((_e75 < _e77)) {
        } else {
            break;
        }
        {
            float _e79 = w00_6;
            int _e80 = row_7;
            int _e82 = size_columns(1);
            int _e84 = place_6;
            int _e87 = size_columns(2);
            int _e89 = c_15;
            int _e92 = size_columns(3);
            float _e96 = read_columns(((((((_e80 * _e82) + _e84) * _e87) + _e89) * _e92) + 0));
            float _e98 = w01_6;
            int _e99 = row_7;
            int _e101 = size_columns(1);
            int _e103 = place_6;
            int _e108 = size_columns(2);
            int _e110 = c_15;
            int _e113 = size_columns(3);
            float _e117 = read_columns(((((((_e99 * _e101) + (_e103 + 1)) * _e108) + _e110) * _e113) + 0));
            float _e120 = w10_6;
            int _e121 = row_7;
            int _e125 = size_columns(1);
            int _e127 = place_6;
            int _e130 = size_columns(2);
            int _e132 = c_15;
            int _e135 = size_columns(3);
            float _e139 = read_columns((((((((_e121 + 1) * _e125) + _e127) * _e130) + _e132) * _e135) + 0));
            float _e142 = w11_6;
            int _e143 = row_7;
            int _e147 = size_columns(1);
            int _e149 = place_6;
            int _e154 = size_columns(2);
            int _e156 = c_15;
            int _e159 = size_columns(3);
            float _e163 = read_columns((((((((_e143 + 1) * _e147) + (_e149 + 1)) * _e154) + _e156) * _e159) + 0));
            scale_4 = ((((_e79 * _e96) + (_e98 * _e117)) + (_e120 * _e139)) + (_e142 * _e163));
            float _e166 = w00_6;
            int _e167 = row_7;
            int _e169 = size_columns(1);
            int _e171 = place_6;
            int _e174 = size_columns(2);
            int _e176 = c_15;
            int _e179 = size_columns(3);
            float _e183 = read_columns(((((((_e167 * _e169) + _e171) * _e174) + _e176) * _e179) + 1));
            float _e185 = w01_6;
            int _e186 = row_7;
            int _e188 = size_columns(1);
            int _e190 = place_6;
            int _e195 = size_columns(2);
            int _e197 = c_15;
            int _e200 = size_columns(3);
            float _e204 = read_columns(((((((_e186 * _e188) + (_e190 + 1)) * _e195) + _e197) * _e200) + 1));
            float _e207 = w10_6;
            int _e208 = row_7;
            int _e212 = size_columns(1);
            int _e214 = place_6;
            int _e217 = size_columns(2);
            int _e219 = c_15;
            int _e222 = size_columns(3);
            float _e226 = read_columns((((((((_e208 + 1) * _e212) + _e214) * _e217) + _e219) * _e222) + 1));
            float _e229 = w11_6;
            int _e230 = row_7;
            int _e234 = size_columns(1);
            int _e236 = place_6;
            int _e241 = size_columns(2);
            int _e243 = c_15;
            int _e246 = size_columns(3);
            float _e250 = read_columns((((((((_e230 + 1) * _e234) + (_e236 + 1)) * _e241) + _e243) * _e246) + 1));
            scaled_3 = ((((_e166 * _e183) + (_e185 * _e204)) + (_e207 * _e226)) + (_e229 * _e250));
            int _e254 = c_15;
            float _e256 = distance_1_6;
            float _e257 = scaled_3;
            float _e259 = scale_4;
            ground_received_1_above[_e254] = ((_e256 * _e257) / _e259);
        }
    }
    return;
}

vec4 through_columns_5_(int constituents_7) {
    vec4 tau_4 = vec4(0.0);
    int c_16 = 0;
    tau_4 = vec4(0.0);
    c_16 = 0;
    bool loop_init_45 = true;
    while(true) {
        if (!loop_init_45) {
            int _e21 = c_16;
            c_16 = (_e21 + 1);
        }
        loop_init_45 = false;
        int _e6 = c_16;
        if ((_e6 < constituents_7)) {
        } else {
            break;
        }
        {
            vec4 _e8 = tau_4;
            int _e9 = c_16;
            vec4 _e14 = read_extinction(((1 * _e9) + 0));
            int _e16 = c_16;
            float _e18 = ground_received_1_below[_e16];
            tau_4 = (_e8 + (_e14 * _e18));
        }
    }
    vec4 _e24 = tau_4;
    return exp((vec4(0.0) - _e24));
}

vec4 through_columns_6_(int constituents_8) {
    vec4 tau_5 = vec4(0.0);
    int c_17 = 0;
    tau_5 = vec4(0.0);
    c_17 = 0;
    bool loop_init_46 = true;
    while(true) {
        if (!loop_init_46) {
            int _e21 = c_17;
            c_17 = (_e21 + 1);
        }
        loop_init_46 = false;
        int _e6 = c_17;
        if ((_e6 < constituents_8)) {
        } else {
            break;
        }
        {
            vec4 _e8 = tau_5;
            int _e9 = c_17;
            vec4 _e14 = read_extinction(((1 * _e9) + 0));
            int _e16 = c_17;
            float _e18 = ground_received_1_above[_e16];
            tau_5 = (_e8 + (_e14 * _e18));
        }
    }
    vec4 _e24 = tau_5;
    return exp((vec4(0.0) - _e24));
}

vec4 level_star_1_(float from_low, float from_high, int constituents_9) {
    vec4 low_9 = vec4(0.0);
    vec4 high_6 = vec4(0.0);
    vec4 _e5 = through_columns_5_(constituents_9);
    low_9 = _e5;
    vec4 _e6 = through_columns_6_(constituents_9);
    high_6 = _e6;
    vec4 _e7 = low_9;
    vec4 _e9 = high_6;
    return ((_e7 * from_low) + (_e9 * from_high));
}

void ground_received_1_(float mu_s_8, int orders_1) {
    float bottom_9 = 0.0;
    float top_9 = 0.0;
    vec4 received_3 = vec4(0.0);
    float from_low_1 = 0.0;
    float from_high_1 = 0.0;
    float low_10 = 0.0;
    float high_7 = 0.0;
    float x_23 = 0.0;
    int place_7 = 0;
    float now_1_6 = _group_0_binding_0_fs.shell.x;
    float now_2_7 = _group_0_binding_0_fs.shell.y;
    bottom_9 = now_1_6;
    top_9 = now_2_7;
    received_3 = vec4(0.0);
    if ((orders_1 != 0)) {
        float _e23 = bottom_9;
        float _e24 = bottom_9;
        float _e25 = top_9;
        float _e29 = _group_0_binding_0_fs.shell.z;
        Several_f32_f32_f32_f32_ _e30 = level_light(_e23, mu_s_8, _e24, _e25, _e29);
        from_low_1 = _e30.v0_;
        from_high_1 = _e30.v1_;
        low_10 = _e30.v2_;
        high_7 = _e30.v3_;
        float _e35 = from_low_1;
        float _e36 = from_high_1;
        if (((_e35 + _e36) > 0.0)) {
            float _e40 = bottom_9;
            float _e41 = low_10;
            float _e42 = bottom_9;
            float _e43 = top_9;
            columns_to_top_3_(_e40, _e41, _e42, _e43);
            float _e44 = bottom_9;
            float _e45 = high_7;
            float _e46 = bottom_9;
            float _e47 = top_9;
            columns_to_top_4_(_e44, _e45, _e46, _e47);
            float _e48 = from_low_1;
            float _e49 = from_high_1;
            float _e53 = _group_0_binding_0_fs.counts.x;
            vec4 _e55 = level_star_1_(_e48, _e49, int(_e53));
            received_3 = _e55;
        }
    }
    if ((orders_1 != 1)) {
        float _e58 = place_of(mu_s_8);
        x_23 = _e58;
        float _e59 = x_23;
        float _e64 = _group_0_binding_0_fs.counts.w;
        place_7 = min(int(_e59), (int(_e64) - 2));
        vec4 _e69 = received_3;
        int _e70 = place_7;
        float _e71 = x_23;
        int _e72 = place_7;
        vec4 _e75 = level_sky(_e70, (_e71 - float(_e72)));
        received_3 = (_e69 + _e75);
    }
    vec4 _e79 = received_3;
    look_1_received[0] = _e79;
    return;
}

float look_1_(float mu_20, float sine_1_5, float cos_azimuth_1, bool to_ground) {
    float nu_3 = 0.0;
    float r_20 = 0.0;
    float start_mu = 0.0;
    float start_mu_s = 0.0;
    float impact_1 = 0.0;
    float across_3 = 0.0;
    float up_1 = 0.0;
    float length_1_5 = 0.0;
    vec4 ground = vec4(0.0);
    float angle_3 = 0.0;
    float mu_s_9 = 0.0;
    float slant_1 = 0.0;
    float _e20 = _group_0_binding_0_fs.star.x;
    float _e25 = _group_0_binding_0_fs.star.y;
    nu_3 = min(max((((sine_1_5 * cos_azimuth_1) * _e20) + (mu_20 * _e25)), -1.0), 1.0);
    float now_1_7 = _group_0_binding_0_fs.observer.x;
    float now_3_8 = _group_0_binding_0_fs.star.y;
    r_20 = now_1_7;
    start_mu = mu_20;
    start_mu_s = now_3_8;
    float _e43 = _group_0_binding_0_fs.observer.x;
    impact_1 = (_e43 * sine_1_5);
    float _e48 = _group_0_binding_0_fs.observer.y;
    if ((_e48 > 0.5)) {
        float _e54 = _group_0_binding_0_fs.shell.y;
        r_20 = _e54;
        float _e55 = impact_1;
        float _e59 = _group_0_binding_0_fs.shell.y;
        float _e64 = _group_0_binding_0_fs.shell.y;
        Several_f32_f32_ _e65 = first_meeting(min(_e55, _e59), sine_1_5, _e64);
        across_3 = _e65.v0_;
        up_1 = _e65.v1_;
        float _e71 = _group_0_binding_0_fs.shell.y;
        float _e72 = impact_1;
        float _e77 = _group_0_binding_0_fs.shell.y;
        float _e78 = impact_1;
        float _e88 = _group_0_binding_0_fs.shell.y;
        start_mu = (-(sqrt(max(((_e71 - _e72) * (_e77 + _e78)), 0.0))) / _e88);
        float _e90 = across_3;
        float _e91 = up_1;
        float _e95 = _group_0_binding_0_fs.shell.y;
        float _e99 = _group_0_binding_0_fs.star.x;
        float _e103 = _group_0_binding_0_fs.star.y;
        float _e104 = star_from(_e90, _e91, _e95, cos_azimuth_1, _e99, _e103);
        start_mu_s = _e104;
    }
    float _e105 = r_20;
    float _e106 = start_mu;
    float _e110 = _group_0_binding_0_fs.shell.y;
    float _e111 = distance_to_top(_e105, _e106, _e110);
    length_1_5 = _e111;
    if (to_ground) {
        float _e112 = r_20;
        float _e113 = start_mu;
        float _e117 = _group_0_binding_0_fs.shell.x;
        float _e118 = distance_to_bottom(_e112, _e113, _e117);
        length_1_5 = _e118;
    }
    float _e119 = r_20;
    float _e120 = start_mu;
    float _e121 = start_mu_s;
    float _e122 = nu_3;
    float _e123 = length_1_5;
    float _e127 = _group_0_binding_0_fs.peaks.w;
    march_line_1_(_e119, _e120, _e121, _e122, _e123, int(_e127));
    ground = vec4(0.0);
    angle_3 = 0.0;
    if (to_ground) {
        float _e132 = impact_1;
        float _e136 = _group_0_binding_0_fs.shell.x;
        float _e141 = _group_0_binding_0_fs.shell.x;
        Several_f32_f32_ _e142 = first_meeting(min(_e132, _e136), sine_1_5, _e141);
        across_3 = _e142.v0_;
        up_1 = _e142.v1_;
        float _e145 = across_3;
        float _e146 = up_1;
        float _e150 = _group_0_binding_0_fs.shell.x;
        float _e154 = _group_0_binding_0_fs.star.x;
        float _e158 = _group_0_binding_0_fs.star.y;
        float _e159 = star_from(_e145, _e146, _e150, cos_azimuth_1, _e154, _e158);
        mu_s_9 = _e159;
        float _e163 = _group_0_binding_0_fs.shell.w;
        if ((_e163 > 0.0)) {
            float _e166 = r_20;
            float _e167 = start_mu;
            float _e171 = _group_0_binding_0_fs.shell.w;
            float _e176 = _group_0_binding_0_fs.counts.x;
            float _e181 = look_1_totals[(int(_e176) - 1)];
            float _e182 = bend_angle(_e166, _e167, _e171, _e181);
            angle_3 = _e182;
            float _e183 = r_20;
            float _e184 = start_mu;
            float _e186 = length_1_5;
            float _e191 = _group_0_binding_0_fs.shell.x;
            slant_1 = (((_e183 * _e184) + _e186) / _e191);
            float _e193 = slant_1;
            float _e194 = mu_s_9;
            float _e195 = nu_3;
            float _e196 = angle_3;
            Several_f32_f32_ _e197 = turned(_e193, _e194, _e195, _e196);
            mu_s_9 = _e197.v0_;
            float _e199 = mu_s_9;
            mu_s_9 = min(max(_e199, -1.0), 1.0);
        }
        float _e204 = mu_s_9;
        float _e208 = _group_0_binding_0_fs.peaks.w;
        ground_received_1_(_e204, int(_e208));
        vec4 _e212 = look_1_received[0];
        vec4 _e215 = reflected(_e212, vec4(1.0));
        vec4 _e218 = look_1_along[1];
        ground = (_e215 * _e218);
    }
    vec4 _e224 = look_1_along[0];
    air_texel_1_found[0] = _e224;
    vec4 _e227 = ground;
    air_texel_1_found[1] = _e227;
    vec4 _e232 = look_1_along[2];
    air_texel_1_found[2] = _e232;
    vec4 _e237 = look_1_along[3];
    air_texel_1_found[3] = _e237;
    float _e238 = angle_3;
    return _e238;
}

void air_texel_1_(int column_2, int row_8, int columns, int rows) {
    bool sky_2 = false;
    float at_5 = 0.0;
    float azimuth = 0.0;
    float cos_azimuth_2 = 0.0;
    float sine_1_6 = 0.0;
    float mu_21 = 0.0;
    float side = 0.0;
    float half_sine_2 = 0.0;
    int layer = 0;
    sky_2 = (row_8 < rows);
    bool _e15 = sky_2;
    at_5 = (float((_e15 ? row_8 : (row_8 - rows))) / float((rows - 1)));
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
        sine_1_6 = (_e47 / _e51);
        float _e53 = sine_1_6;
        float _e56 = sine_1_6;
        mu_21 = -(sqrt(max(((1.0 - _e53) * (1.0 + _e56)), 0.0)));
    } else {
        float _e64 = at_5;
        bool _e65 = sky_2;
        float _e69 = _group_0_binding_0_fs.observer.z;
        float _e73 = _group_0_binding_0_fs.observer.w;
        Several_f32_f32_ _e74 = direction_from_row(_e64, _e65, _e69, _e73);
        mu_21 = _e74.v0_;
        sine_1_6 = _e74.v1_;
    }
    float _e77 = cos_azimuth_2;
    float _e80 = cos_azimuth_2;
    side = sqrt(max(((1.0 - _e77) * (1.0 + _e80)), 0.0));
    float _e87 = sine_1_6;
    float _e88 = cos_azimuth_2;
    float _e90 = sine_1_6;
    float _e91 = side;
    float _e93 = mu_21;
    float _e97 = _group_0_binding_0_fs.star.z;
    float _e101 = _group_0_binding_0_fs.star.w;
    float _e102 = half_sine_between((_e87 * _e88), (_e90 * _e91), _e93, _e97, _e101);
    half_sine_2 = _e102;
    float _e103 = half_sine_2;
    phases_towards_1_(_e103);
    float _e104 = mu_21;
    float _e105 = sine_1_6;
    float _e106 = cos_azimuth_2;
    bool _e107 = sky_2;
    float _e109 = look_1_(_e104, _e105, _e106, !(_e107));
    layer = 0;
    bool loop_init_47 = true;
    while(true) {
        if (!loop_init_47) {
            int _e130 = layer;
            layer = (_e130 + 1);
        }
        loop_init_47 = false;
        int _e111 = layer;
        if ((_e111 < 4)) {
        } else {
            break;
        }
        {
            int _e115 = layer;
            int _e120 = layer;
            vec4 _e124 = air_texel_1_found[(1 * _e120)];
            sky_air_found[(1 * _e115)] = sqrt(sqrt(max(_e124, vec4(0.0))));
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
    air_texel_1_((number % columns_1), (number / columns_1), columns_1, int(_e18));
    vec4 _e22 = sky_air_found[0];
    vec4 _e25 = sky_air_found[1];
    Layers _tmp_return = Layers(_e22, _e25);
    _fs2p_location0 = _tmp_return.first;
    _fs2p_location1 = _tmp_return.second;
    return;
}
