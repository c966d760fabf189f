#version 300 es
// of picture.wgsl dd7c9bef7a2f9f31, by naga-wasm@30.1.0
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
struct Several_f32_f32_f32_ {
    float v0_;
    float v1_;
    float v2_;
};
struct Several_f32_f32_ {
    float v0_;
    float v1_;
};
layout(std140) uniform Frame_block_0Fragment { Frame _group_0_binding_0_fs; };

uniform highp sampler2D _group_0_binding_1_fs;

uniform highp sampler2D _group_0_binding_2_fs;

uniform highp sampler2D _group_0_binding_4_fs;

uniform highp sampler2D _group_0_binding_5_fs;

uniform highp sampler2D _group_0_binding_6_fs;

uniform highp sampler2D _group_0_binding_7_fs;

uniform highp sampler2D _group_0_binding_8_fs;

float reflectance_color[3];

float star_disc_here[8];

vec4 light_of_found[1];

layout(location = 0) out vec4 _fs2p_location0;

int size_columns(int axis) {
    float _e8 = _group_0_binding_0_fs.table_columns[(min(axis, 2) + 1)];
    return ((axis == 3) ? 2 : int(_e8));
}

float read_columns(int index) {
    float _e4 = _group_0_binding_0_fs.table_columns.x;
    int at_4 = (index + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_4 & 2047), (at_4 >> 11u)), 0);
    return _e14.x;
}

int size_density(int axis_1) {
    float _e6 = _group_0_binding_0_fs.table_density[(axis_1 + 1)];
    return int(_e6);
}

float read_density(int index_1) {
    float _e4 = _group_0_binding_0_fs.table_density.x;
    int at_5 = (index_1 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_5 & 2047), (at_5 >> 11u)), 0);
    return _e14.x;
}

int size_strongest(int axis_2) {
    float _e6 = _group_0_binding_0_fs.table_strongest[(axis_2 + 1)];
    return int(_e6);
}

float read_strongest(int index_2) {
    float _e4 = _group_0_binding_0_fs.table_strongest.x;
    int at_6 = (index_2 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_6 & 2047), (at_6 >> 11u)), 0);
    return _e14.x;
}

int size_brightest(int axis_3) {
    float _e6 = _group_0_binding_0_fs.table_brightest[(axis_3 + 1)];
    return int(_e6);
}

float read_brightest(int index_3) {
    float _e4 = _group_0_binding_0_fs.table_brightest.x;
    int at_7 = (index_3 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_7 & 2047), (at_7 >> 11u)), 0);
    return _e14.x;
}

int size_lift(int axis_4) {
    float _e6 = _group_0_binding_0_fs.table_lift[(axis_4 + 1)];
    return int(_e6);
}

float read_lift(int index_4) {
    float _e4 = _group_0_binding_0_fs.table_lift.x;
    int at_8 = (index_4 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_8 & 2047), (at_8 >> 11u)), 0);
    return _e14.x;
}

int size_ends(int axis_5) {
    float _e6 = _group_0_binding_0_fs.table_ends[(axis_5 + 1)];
    return int(_e6);
}

float read_ends(int index_5) {
    float _e4 = _group_0_binding_0_fs.table_ends.x;
    int at_9 = (index_5 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_9 & 2047), (at_9 >> 11u)), 0);
    return _e14.x;
}

int size_row(int axis_6) {
    float _e6 = _group_0_binding_0_fs.table_row[(axis_6 + 1)];
    return int(_e6);
}

float read_row(int index_6) {
    float _e4 = _group_0_binding_0_fs.table_row.x;
    int at_10 = (index_6 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_10 & 2047), (at_10 >> 11u)), 0);
    return _e14.x;
}

int size_place(int axis_7) {
    float _e6 = _group_0_binding_0_fs.table_place[(axis_7 + 1)];
    return int(_e6);
}

float read_place(int index_7) {
    float _e4 = _group_0_binding_0_fs.table_place.x;
    int at_11 = (index_7 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_11 & 2047), (at_11 >> 11u)), 0);
    return _e14.x;
}

int size_start(int axis_8) {
    float _e6 = _group_0_binding_0_fs.table_start[(axis_8 + 1)];
    return int(_e6);
}

float read_start(int index_8) {
    float _e4 = _group_0_binding_0_fs.table_start.x;
    int at_12 = (index_8 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_12 & 2047), (at_12 >> 11u)), 0);
    return _e14.x;
}

int size_ahead(int axis_9) {
    float _e6 = _group_0_binding_0_fs.table_ahead[(axis_9 + 1)];
    return int(_e6);
}

float read_ahead(int index_9) {
    float _e4 = _group_0_binding_0_fs.table_ahead.x;
    int at_13 = (index_9 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_13 & 2047), (at_13 >> 11u)), 0);
    return _e14.x;
}

int size_back(int axis_10) {
    float _e6 = _group_0_binding_0_fs.table_back[(axis_10 + 1)];
    return int(_e6);
}

float read_back(int index_10) {
    float _e4 = _group_0_binding_0_fs.table_back.x;
    int at_14 = (index_10 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_14 & 2047), (at_14 >> 11u)), 0);
    return _e14.x;
}

int size_rules(int axis_11) {
    float _e6 = _group_0_binding_0_fs.table_rules[(axis_11 + 1)];
    return int(_e6);
}

float read_rules(int index_11) {
    float _e4 = _group_0_binding_0_fs.table_rules.x;
    int at_15 = (index_11 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_1_fs, ivec2((at_15 & 2047), (at_15 >> 11u)), 0);
    return _e14.x;
}

int size_extinction(int axis_12) {
    float _e6 = _group_0_binding_0_fs.table_extinction[(axis_12 + 1)];
    return int(_e6);
}

vec4 read_extinction(int index_12) {
    float _e4 = _group_0_binding_0_fs.table_extinction.x;
    int at_16 = (index_12 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_16 & 2047), (at_16 >> 11u)), 0);
    return _e14;
}

int size_scattering(int axis_13) {
    float _e6 = _group_0_binding_0_fs.table_scattering[(axis_13 + 1)];
    return int(_e6);
}

vec4 read_scattering(int index_13) {
    float _e4 = _group_0_binding_0_fs.table_scattering.x;
    int at_17 = (index_13 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_17 & 2047), (at_17 >> 11u)), 0);
    return _e14;
}

int size_moments(int axis_14) {
    float _e6 = _group_0_binding_0_fs.table_moments[(axis_14 + 1)];
    return int(_e6);
}

vec4 read_moments(int index_14) {
    float _e4 = _group_0_binding_0_fs.table_moments.x;
    int at_18 = (index_14 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_18 & 2047), (at_18 >> 11u)), 0);
    return _e14;
}

int size_albedo(int axis_15) {
    float _e6 = _group_0_binding_0_fs.table_albedo[(axis_15 + 1)];
    return int(_e6);
}

vec4 read_albedo(int index_15) {
    float _e4 = _group_0_binding_0_fs.table_albedo.x;
    int at_19 = (index_15 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_19 & 2047), (at_19 >> 11u)), 0);
    return _e14;
}

int size_phase(int axis_16) {
    float _e6 = _group_0_binding_0_fs.table_phase[(axis_16 + 1)];
    return int(_e6);
}

vec4 read_phase(int index_16) {
    float _e4 = _group_0_binding_0_fs.table_phase.x;
    int at_20 = (index_16 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_20 & 2047), (at_20 >> 11u)), 0);
    return _e14;
}

int size_basis(int axis_17) {
    float _e6 = _group_0_binding_0_fs.table_basis[(axis_17 + 1)];
    return int(_e6);
}

vec4 read_basis(int index_17) {
    float _e4 = _group_0_binding_0_fs.table_basis.x;
    int at_21 = (index_17 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_2_fs, ivec2((at_21 & 2047), (at_21 >> 11u)), 0);
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

int size_levels(int axis_20) {
    float _e6 = _group_0_binding_0_fs.table_levels[(axis_20 + 1)];
    return int(_e6);
}

float read_levels(int index_20) {
    float _e4 = _group_0_binding_0_fs.table_levels.x;
    int at_22 = (index_20 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_4_fs, ivec2((at_22 & 2047), (at_22 >> 11u)), 0);
    return _e14.x;
}

int size_texels(int axis_21) {
    float _e6 = _group_0_binding_0_fs.table_texels[(axis_21 + 1)];
    return int(_e6);
}

float read_texels(int index_21) {
    float _e4 = _group_0_binding_0_fs.table_texels.x;
    int at_23 = (index_21 + int(_e4));
    vec4 _e14 = texelFetch(_group_0_binding_4_fs, ivec2((at_23 & 2047), (at_23 >> 11u)), 0);
    return _e14.x;
}

vec4 read_sky_air(int index_22) {
    vec4 _e8 = texelFetch(_group_0_binding_5_fs, ivec2((index_22 & 2047), (index_22 >> 11u)), 0);
    return _e8;
}

vec4 read_sky_ground(int index_23) {
    vec4 _e8 = texelFetch(_group_0_binding_6_fs, ivec2((index_23 & 2047), (index_23 >> 11u)), 0);
    return _e8;
}

vec4 read_sky_first(int index_24) {
    vec4 _e8 = texelFetch(_group_0_binding_7_fs, ivec2((index_24 & 2047), (index_24 >> 11u)), 0);
    return _e8;
}

vec4 read_sky_second(int index_25) {
    vec4 _e8 = texelFetch(_group_0_binding_8_fs, ivec2((index_25 & 2047), (index_25 >> 11u)), 0);
    return _e8;
}

float squared(float x) {
    return (x * x);
}

float cubed(float x_1) {
    return ((x_1 * x_1) * x_1);
}

float sine_of_quarter(float x_2) {
    float y_19 = (x_2 * x_2);
    return (x_2 + ((x_2 * y_19) * (-0.16666655 + (y_19 * (0.008332161 - (0.00019515296 * y_19))))));
}

float cosine_of_quarter(float x_3) {
    float y_20 = (x_3 * x_3);
    float tail = ((y_20 * y_20) * (0.041666646 + (y_20 * (-0.0013887316 + (2.4433157e-5 * y_20)))));
    return ((1.0 - (0.5 * y_20)) + tail);
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

Several_f32_f32_f32_ perspective_ray(float x_7, float y, float width, float height, float field_of_view) {
    float slope = 0.0;
    float right = 0.0;
    float up = 0.0;
    float length_1_ = 0.0;
    float _e11 = sine((0.5 * field_of_view));
    float _e14 = cosine((0.5 * field_of_view));
    slope = (_e11 / _e14);
    float _e20 = slope;
    right = ((((2.0 * x_7) - width) / width) * _e20);
    float _e26 = slope;
    up = (((height - (2.0 * y)) / width) * _e26);
    float _e28 = right;
    float _e29 = right;
    float _e33 = up;
    float _e34 = up;
    length_1_ = sqrt(((1.0 + (_e28 * _e29)) + (_e33 * _e34)));
    float _e38 = right;
    float _e39 = length_1_;
    float _e41 = up;
    float _e42 = length_1_;
    float _e44 = length_1_;
    return Several_f32_f32_f32_((_e38 / _e39), (_e41 / _e42), (1.0 / _e44));
}

Several_f32_f32_f32_ fisheye_ray(float x_8, float y_1, float width_1, float height_1, float field_of_view_1) {
    float diameter = 0.0;
    float across = 0.0;
    float up_1 = 0.0;
    float square = 0.0;
    float distance_1_ = 0.0;
    float theta = 0.0;
    float scale = 0.0;
    diameter = min(width_1, height_1);
    across = ((2.0 * x_8) - width_1);
    up_1 = (height_1 - (2.0 * y_1));
    float _e19 = across;
    float _e20 = across;
    float _e22 = up_1;
    float _e23 = up_1;
    square = ((_e19 * _e20) + (_e22 * _e23));
    float _e26 = square;
    float _e27 = diameter;
    float _e28 = diameter;
    if ((_e26 > (_e27 * _e28))) {
        return Several_f32_f32_f32_(0.0, 0.0, 0.0);
    }
    float _e35 = square;
    distance_1_ = sqrt(_e35);
    float _e39 = distance_1_;
    float _e41 = diameter;
    theta = (((0.5 * field_of_view_1) * _e39) / _e41);
    float _e43 = theta;
    float _e44 = sine(_e43);
    float _e45 = distance_1_;
    scale = (_e44 / max(_e45, 1e-12));
    float _e49 = scale;
    float _e50 = across;
    float _e52 = scale;
    float _e53 = up_1;
    float _e55 = theta;
    float _e56 = cosine(_e55);
    return Several_f32_f32_f32_((_e49 * _e50), (_e52 * _e53), _e56);
}

Several_f32_f32_f32_ panorama_ray(float x_9, float y_2, float width_2, float height_2, float field_of_view_2) {
    float azimuth = 0.0;
    float elevation = 0.0;
    float level = 0.0;
    azimuth = (6.2831855 * ((x_9 / width_2) - 0.5));
    elevation = (3.1415927 * (0.5 - (y_2 / height_2)));
    float _e18 = elevation;
    float _e19 = cosine(_e18);
    level = _e19;
    float _e20 = level;
    float _e21 = azimuth;
    float _e22 = sine(_e21);
    float _e24 = elevation;
    float _e25 = sine(_e24);
    float _e26 = level;
    float _e27 = azimuth;
    float _e28 = cosine(_e27);
    return Several_f32_f32_f32_((_e20 * _e22), _e25, (_e26 * _e28));
}

Several_f32_f32_f32_ cube_ray(float x_10, float y_3, float width_3, float height_3, float field_of_view_3) {
    int face = 0;
    float across_1 = 0.0;
    float above = 0.0;
    float right_1 = 0.0;
    float up_2 = 0.0;
    float forward = 0.0;
    float length_1_1 = 0.0;
    face = min(max(int(floor((x_10 / height_3))), 0), 5);
    int _e20 = face;
    across_1 = ((2.0 * ((x_10 / height_3) - float(_e20))) - 1.0);
    above = (1.0 - ((2.0 * y_3) / height_3));
    int _e32 = face;
    if ((_e32 == 0)) {
        float now_2_ = above;
        float _e37 = across_1;
        float now_3_ = -(_e37);
        right_1 = 1.0;
        up_2 = now_2_;
        forward = now_3_;
    } else {
        int _e39 = face;
        if ((_e39 == 1)) {
            float now_5_ = above;
            float now_6_ = across_1;
            right_1 = -1.0;
            up_2 = now_5_;
            forward = now_6_;
        } else {
            int _e45 = face;
            if ((_e45 == 2)) {
                float now_7_ = across_1;
                float _e50 = above;
                float now_9_ = -(_e50);
                right_1 = now_7_;
                up_2 = 1.0;
                forward = now_9_;
            } else {
                int _e52 = face;
                if ((_e52 == 3)) {
                    float now_10_ = across_1;
                    float now_12_ = above;
                    right_1 = now_10_;
                    up_2 = -1.0;
                    forward = now_12_;
                } else {
                    int _e58 = face;
                    if ((_e58 == 4)) {
                        float now_13_ = across_1;
                        float now_14_ = above;
                        right_1 = now_13_;
                        up_2 = now_14_;
                        forward = 1.0;
                    } else {
                        float _e64 = across_1;
                        float now_16_ = -(_e64);
                        float now_17_ = above;
                        right_1 = now_16_;
                        up_2 = now_17_;
                        forward = -1.0;
                    }
                }
            }
        }
    }
    float _e68 = across_1;
    float _e69 = across_1;
    float _e73 = above;
    float _e74 = above;
    length_1_1 = sqrt(((1.0 + (_e68 * _e69)) + (_e73 * _e74)));
    float _e78 = right_1;
    float _e79 = length_1_1;
    float _e81 = up_2;
    float _e82 = length_1_1;
    float _e84 = forward;
    float _e85 = length_1_1;
    return Several_f32_f32_f32_((_e78 / _e79), (_e81 / _e82), (_e84 / _e85));
}

Several_f32_f32_f32_ projected_ray(int projection, float x_11, float y_4, float width_4, float height_4, float field_of_view_4) {
    if ((projection == 0)) {
        Several_f32_f32_f32_ _e8 = perspective_ray(x_11, y_4, width_4, height_4, field_of_view_4);
        return _e8;
    }
    if ((projection == 1)) {
        Several_f32_f32_f32_ _e11 = fisheye_ray(x_11, y_4, width_4, height_4, field_of_view_4);
        return _e11;
    }
    if ((projection == 2)) {
        Several_f32_f32_f32_ _e14 = panorama_ray(x_11, y_4, width_4, height_4, field_of_view_4);
        return _e14;
    }
    Several_f32_f32_f32_ _e15 = cube_ray(x_11, y_4, width_4, height_4, field_of_view_4);
    return _e15;
}

float angle_above_horizon(float mu, float sine_1_, float horizon_mu, float horizon_sine) {
    float across_2 = 0.0;
    across_2 = ((mu * horizon_sine) - (sine_1_ * horizon_mu));
    float _e8 = across_2;
    return atan(_e8, ((mu * horizon_mu) + (sine_1_ * horizon_sine)));
}

float row_from_angle(float angle, float horizon_mu_1) {
    float highest = 0.0;
    float part = 0.0;
    highest = acos(horizon_mu_1);
    float _e5 = highest;
    float _e9 = highest;
    part = ((angle > 0.0) ? (angle / _e9) : (angle / (_e5 - 3.1415927)));
    float _e14 = part;
    return sqrt(min(max(_e14, 0.0), 1.0));
}

float row_from_impact(float impact, float bottom_radius, float top_radius) {
    float part_1 = 0.0;
    if ((impact < bottom_radius)) {
        part_1 = ((bottom_radius - impact) / bottom_radius);
    } else {
        part_1 = ((impact - bottom_radius) / (top_radius - bottom_radius));
    }
    float _e10 = part_1;
    return sqrt(min(max(_e10, 0.0), 1.0));
}

float half_sine_between(float x_12, float y_5, float z, float sun_x, float sun_z) {
    float across_3 = 0.0;
    across_3 = (((x_12 - sun_x) * (x_12 - sun_x)) + (y_5 * y_5));
    float _e11 = across_3;
    return min((0.5 * sqrt((_e11 + ((z - sun_z) * (z - sun_z))))), 1.0);
}

vec4 between_texels(int columns, int rows, float row, bool sky, float azimuth_1) {
    float x_13 = 0.0;
    int column = 0;
    float e = 0.0;
    float y_6 = 0.0;
    int line = 0;
    float f = 0.0;
    float g = 0.0;
    float h = 0.0;
    int near = 0;
    int far = 0;
    vec4 root = vec4(0.0);
    vec4 square_1 = vec4(0.0);
    x_13 = (min(max(azimuth_1, 0.0), 1.0) * float((columns - 1)));
    float _e25 = x_13;
    column = min(int(_e25), (columns - 2));
    float _e30 = x_13;
    int _e31 = column;
    e = (_e30 - float(_e31));
    y_6 = (row * float((rows - 1)));
    float _e38 = y_6;
    line = min(int(_e38), (rows - 2));
    float _e43 = y_6;
    int _e44 = line;
    f = (_e43 - float(_e44));
    float _e47 = f;
    float now_1_ = (1.0 - _e47);
    float _e50 = e;
    float now_2_1 = (1.0 - _e50);
    g = now_1_;
    h = now_2_1;
    int _e53 = line;
    int _e55 = line;
    int _e58 = column;
    near = (1 * (((sky ? _e55 : (_e53 + rows)) * columns) + _e58));
    int _e62 = near;
    far = (_e62 + (1 * columns));
    int _e66 = near;
    vec4 _e67 = read_sky_air(_e66);
    float _e68 = g;
    float _e69 = h;
    int _e72 = near;
    vec4 _e75 = read_sky_air((_e72 + 1));
    float _e76 = g;
    float _e77 = e;
    int _e81 = far;
    vec4 _e82 = read_sky_air(_e81);
    float _e83 = f;
    float _e84 = h;
    int _e88 = far;
    vec4 _e91 = read_sky_air((_e88 + 1));
    float _e92 = f;
    float _e93 = e;
    root = ((((_e67 * (_e68 * _e69)) + (_e75 * (_e76 * _e77))) + (_e82 * (_e83 * _e84))) + (_e91 * (_e92 * _e93)));
    vec4 _e97 = root;
    vec4 _e98 = root;
    square_1 = (_e97 * _e98);
    vec4 _e100 = square_1;
    vec4 _e101 = square_1;
    return (_e100 * _e101);
}

vec4 between_texels_2_(int columns_1, int rows_1, float row_1, float azimuth_2) {
    float x_14 = 0.0;
    int column_1 = 0;
    float e_1 = 0.0;
    float y_7 = 0.0;
    int line_1 = 0;
    float f_1 = 0.0;
    float g_1 = 0.0;
    float h_1 = 0.0;
    int near_1 = 0;
    int far_1 = 0;
    vec4 root_1 = vec4(0.0);
    vec4 square_2 = vec4(0.0);
    x_14 = (min(max(azimuth_2, 0.0), 1.0) * float((columns_1 - 1)));
    float _e24 = x_14;
    column_1 = min(int(_e24), (columns_1 - 2));
    float _e29 = x_14;
    int _e30 = column_1;
    e_1 = (_e29 - float(_e30));
    y_7 = (row_1 * float((rows_1 - 1)));
    float _e37 = y_7;
    line_1 = min(int(_e37), (rows_1 - 2));
    float _e42 = y_7;
    int _e43 = line_1;
    f_1 = (_e42 - float(_e43));
    float _e46 = f_1;
    float now_1_1 = (1.0 - _e46);
    float _e49 = e_1;
    float now_2_2 = (1.0 - _e49);
    g_1 = now_1_1;
    h_1 = now_2_2;
    int _e52 = line_1;
    int _e55 = column_1;
    near_1 = (1 * (((_e52 + rows_1) * columns_1) + _e55));
    int _e59 = near_1;
    far_1 = (_e59 + (1 * columns_1));
    int _e63 = near_1;
    vec4 _e64 = read_sky_ground(_e63);
    float _e65 = g_1;
    float _e66 = h_1;
    int _e69 = near_1;
    vec4 _e72 = read_sky_ground((_e69 + 1));
    float _e73 = g_1;
    float _e74 = e_1;
    int _e78 = far_1;
    vec4 _e79 = read_sky_ground(_e78);
    float _e80 = f_1;
    float _e81 = h_1;
    int _e85 = far_1;
    vec4 _e88 = read_sky_ground((_e85 + 1));
    float _e89 = f_1;
    float _e90 = e_1;
    root_1 = ((((_e64 * (_e65 * _e66)) + (_e72 * (_e73 * _e74))) + (_e79 * (_e80 * _e81))) + (_e88 * (_e89 * _e90)));
    vec4 _e94 = root_1;
    vec4 _e95 = root_1;
    square_2 = (_e94 * _e95);
    vec4 _e97 = square_2;
    vec4 _e98 = square_2;
    return (_e97 * _e98);
}

vec4 phase_of(float half_sine, int constituent) {
    float u = 0.0;
    int node = 0;
    float f_2 = 0.0;
    int at_2 = 0;
    vec4 low = vec4(0.0);
    float _e10 = _group_0_binding_0_fs.peaks.x;
    u = (half_sine * float((int(_e10) - 1)));
    float _e16 = u;
    float _e21 = _group_0_binding_0_fs.peaks.x;
    node = min(int(_e16), (int(_e21) - 2));
    float _e26 = u;
    int _e27 = node;
    f_2 = (_e26 - float(_e27));
    int _e30 = node;
    float _e34 = _group_0_binding_0_fs.counts.x;
    at_2 = (1 * ((_e30 * int(_e34)) + constituent));
    int _e40 = at_2;
    vec4 _e41 = read_phase(_e40);
    low = _e41;
    vec4 _e42 = low;
    float _e43 = f_2;
    int _e44 = at_2;
    float _e48 = _group_0_binding_0_fs.counts.x;
    vec4 _e53 = read_phase((_e44 + (1 * int(_e48))));
    vec4 _e54 = low;
    return (_e42 + (_e43 * (_e53 - _e54)));
}

vec4 between_texels_3_(int columns_2, int rows_2, float row_2, bool sky_1, float azimuth_3) {
    float x_15 = 0.0;
    int column_2 = 0;
    float e_2 = 0.0;
    float y_8 = 0.0;
    int line_2 = 0;
    float f_3 = 0.0;
    float g_2 = 0.0;
    float h_2 = 0.0;
    int near_2 = 0;
    int far_2 = 0;
    vec4 root_2 = vec4(0.0);
    vec4 square_3 = vec4(0.0);
    x_15 = (min(max(azimuth_3, 0.0), 1.0) * float((columns_2 - 1)));
    float _e25 = x_15;
    column_2 = min(int(_e25), (columns_2 - 2));
    float _e30 = x_15;
    int _e31 = column_2;
    e_2 = (_e30 - float(_e31));
    y_8 = (row_2 * float((rows_2 - 1)));
    float _e38 = y_8;
    line_2 = min(int(_e38), (rows_2 - 2));
    float _e43 = y_8;
    int _e44 = line_2;
    f_3 = (_e43 - float(_e44));
    float _e47 = f_3;
    float now_1_2 = (1.0 - _e47);
    float _e50 = e_2;
    float now_2_3 = (1.0 - _e50);
    g_2 = now_1_2;
    h_2 = now_2_3;
    int _e53 = line_2;
    int _e55 = line_2;
    int _e58 = column_2;
    near_2 = (1 * (((sky_1 ? _e55 : (_e53 + rows_2)) * columns_2) + _e58));
    int _e62 = near_2;
    far_2 = (_e62 + (1 * columns_2));
    int _e66 = near_2;
    vec4 _e67 = read_sky_first(_e66);
    float _e68 = g_2;
    float _e69 = h_2;
    int _e72 = near_2;
    vec4 _e75 = read_sky_first((_e72 + 1));
    float _e76 = g_2;
    float _e77 = e_2;
    int _e81 = far_2;
    vec4 _e82 = read_sky_first(_e81);
    float _e83 = f_3;
    float _e84 = h_2;
    int _e88 = far_2;
    vec4 _e91 = read_sky_first((_e88 + 1));
    float _e92 = f_3;
    float _e93 = e_2;
    root_2 = ((((_e67 * (_e68 * _e69)) + (_e75 * (_e76 * _e77))) + (_e82 * (_e83 * _e84))) + (_e91 * (_e92 * _e93)));
    vec4 _e97 = root_2;
    vec4 _e98 = root_2;
    square_3 = (_e97 * _e98);
    vec4 _e100 = square_3;
    vec4 _e101 = square_3;
    return (_e100 * _e101);
}

vec4 between_texels_4_(int columns_3, int rows_3, float row_3, bool sky_2, float azimuth_4) {
    float x_16 = 0.0;
    int column_3 = 0;
    float e_3 = 0.0;
    float y_9 = 0.0;
    int line_3 = 0;
    float f_4 = 0.0;
    float g_3 = 0.0;
    float h_3 = 0.0;
    int near_3 = 0;
    int far_3 = 0;
    vec4 root_3 = vec4(0.0);
    vec4 square_4 = vec4(0.0);
    x_16 = (min(max(azimuth_4, 0.0), 1.0) * float((columns_3 - 1)));
    float _e25 = x_16;
    column_3 = min(int(_e25), (columns_3 - 2));
    float _e30 = x_16;
    int _e31 = column_3;
    e_3 = (_e30 - float(_e31));
    y_9 = (row_3 * float((rows_3 - 1)));
    float _e38 = y_9;
    line_3 = min(int(_e38), (rows_3 - 2));
    float _e43 = y_9;
    int _e44 = line_3;
    f_4 = (_e43 - float(_e44));
    float _e47 = f_4;
    float now_1_3 = (1.0 - _e47);
    float _e50 = e_3;
    float now_2_4 = (1.0 - _e50);
    g_3 = now_1_3;
    h_3 = now_2_4;
    int _e53 = line_3;
    int _e55 = line_3;
    int _e58 = column_3;
    near_3 = (1 * (((sky_2 ? _e55 : (_e53 + rows_3)) * columns_3) + _e58));
    int _e62 = near_3;
    far_3 = (_e62 + (1 * columns_3));
    int _e66 = near_3;
    vec4 _e67 = read_sky_second(_e66);
    float _e68 = g_3;
    float _e69 = h_3;
    int _e72 = near_3;
    vec4 _e75 = read_sky_second((_e72 + 1));
    float _e76 = g_3;
    float _e77 = e_3;
    int _e81 = far_3;
    vec4 _e82 = read_sky_second(_e81);
    float _e83 = f_4;
    float _e84 = h_3;
    int _e88 = far_3;
    vec4 _e91 = read_sky_second((_e88 + 1));
    float _e92 = f_4;
    float _e93 = e_3;
    root_3 = ((((_e67 * (_e68 * _e69)) + (_e75 * (_e76 * _e77))) + (_e82 * (_e83 * _e84))) + (_e91 * (_e92 * _e93)));
    vec4 _e97 = root_3;
    vec4 _e98 = root_3;
    square_4 = (_e97 * _e98);
    vec4 _e100 = square_4;
    vec4 _e101 = square_4;
    return (_e100 * _e101);
}

Several_f32_f32_ first_meeting(float impact_1, float sine_1_1, float radius) {
    float depth = 0.0;
    float down = 0.0;
    depth = sqrt(max(((radius - impact_1) * (radius + impact_1)), 0.0));
    down = sqrt(max(((1.0 - sine_1_1) * (1.0 + sine_1_1)), 0.0));
    float _e19 = down;
    float _e21 = depth;
    float _e25 = depth;
    float _e26 = down;
    return Several_f32_f32_(((impact_1 * _e19) - (_e21 * sine_1_1)), ((impact_1 * sine_1_1) + (_e25 * _e26)));
}

Several_f32_f32_f32_ moved_on(float x_17, float y_10, float z_1, float dx, float dy, float dz, float cosine_1_, float angle_1, float bottom) {
    float sine_1_2 = 0.0;
    float keep = 0.0;
    float away = 0.0;
    if ((angle_1 == 0.0)) {
        return Several_f32_f32_f32_(x_17, y_10, z_1);
    }
    sine_1_2 = sqrt(max(((1.0 - cosine_1_) * (1.0 + cosine_1_)), 1e-18));
    float _e23 = cosine(angle_1);
    float _e24 = sine(angle_1);
    float _e26 = sine_1_2;
    keep = (_e23 + ((_e24 * cosine_1_) / _e26));
    float _e29 = sine(angle_1);
    float _e31 = sine_1_2;
    away = ((_e29 * bottom) / _e31);
    float _e33 = keep;
    float _e35 = away;
    float _e38 = keep;
    float _e40 = away;
    float _e43 = keep;
    float _e45 = away;
    return Several_f32_f32_f32_(((_e33 * x_17) + (_e35 * dx)), ((_e38 * y_10) + (_e40 * dy)), ((_e43 * z_1) + (_e45 * dz)));
}

Several_f32_f32_ latitude_longitude(float x_18, float y_11, float z_2) {
    return Several_f32_f32_(atan(z_2, sqrt(((x_18 * x_18) + (y_11 * y_11)))), atan(y_11, x_18));
}

float map_level(float pixel_angle, float reach, float cosine_1_1, float bottom_1, float rows_4) {
    float footprint = 0.0;
    footprint = ((pixel_angle * reach) / (bottom_1 * sqrt(max(cosine_1_1, 0.05))));
    float _e12 = footprint;
    return log2(max(((_e12 * rows_4) / 3.1415927), 1e-6));
}

void map_color_1_(float latitude, float longitude, float level_given) {
    float level_1 = 0.0;
    int first = 0;
    int c = 0;
    int step_1_ = 0;
    int which = 0;
    float part_2 = 0.0;
    int start = 0;
    int height_5 = 0;
    int width_5 = 0;
    float y_12 = 0.0;
    float x_19 = 0.0;
    int top = 0;
    int west = 0;
    float down_1 = 0.0;
    float right_2 = 0.0;
    int bottom_2 = 0;
    int east = 0;
    int upper_row = 0;
    int lower_row = 0;
    float upper = 0.0;
    float lower = 0.0;
    level_1 = level_given;
    float _e24 = level_1;
    int _e28 = size_levels(0);
    level_1 = min(max(_e24, 0.0), (float(_e28) - 1.0));
    float _e33 = level_1;
    int _e36 = size_levels(0);
    first = min(int(_e33), max((_e36 - 2), 0));
    c = 0;
    bool loop_init = true;
    while(true) {
        if (!loop_init) {
            int _e50 = c;
            c = (_e50 + 1);
        }
        loop_init = false;
        int _e43 = c;
        if ((_e43 < 3)) {
        } else {
            break;
        }
        {
            int _e47 = c;
            reflectance_color[_e47] = 0.0;
        }
    }
    step_1_ = 0;
    bool loop_init_1 = true;
    while(true) {
        if (!loop_init_1) {
            int _e249 = step_1_;
            step_1_ = (_e249 + 1);
        }
        loop_init_1 = false;
        int _e54 = step_1_;
        if ((_e54 < 2)) {
        } else {
            break;
        }
        {
            int _e57 = first;
            int _e58 = step_1_;
            int _e61 = size_levels(0);
            which = min((_e57 + _e58), (_e61 - 1));
            float _e65 = level_1;
            int _e66 = first;
            float _e71 = level_1;
            int _e72 = first;
            int _e75 = step_1_;
            part_2 = ((_e75 == 1) ? (_e71 - float(_e72)) : (1.0 - (_e65 - float(_e66))));
            float _e79 = part_2;
            if ((_e79 <= 0.0)) {
                continue;
            }
            int _e82 = which;
            int _e84 = size_levels(1);
            float _e88 = read_levels(((_e82 * _e84) + 0));
            start = int(_e88);
            int _e90 = which;
            int _e92 = size_levels(1);
            float _e96 = read_levels(((_e90 * _e92) + 1));
            height_5 = int(_e96);
            int _e98 = which;
            int _e100 = size_levels(1);
            float _e104 = read_levels(((_e98 * _e100) + 2));
            width_5 = int(_e104);
            int _e110 = height_5;
            int _e117 = height_5;
            y_12 = min(max((((0.5 - (latitude / 3.1415927)) * float(_e110)) - 0.5), 0.0), (float(_e117) - 1.0));
            int _e126 = width_5;
            x_19 = (((0.5 + (longitude / 6.2831855)) * float(_e126)) - 0.5);
            float _e131 = y_12;
            int _e133 = height_5;
            top = min(int(_e131), max((_e133 - 2), 0));
            float _e139 = x_19;
            west = int(floor(_e139));
            float _e142 = y_12;
            int _e143 = top;
            float now_1_4 = (_e142 - float(_e143));
            float _e146 = x_19;
            int _e147 = west;
            float now_2_5 = (_e146 - float(_e147));
            down_1 = now_1_4;
            right_2 = now_2_5;
            int _e150 = top;
            int _e153 = height_5;
            bottom_2 = min((_e150 + 1), (_e153 - 1));
            int _e157 = west;
            int _e160 = width_5;
            east = ((_e157 + 1) % _e160);
            int _e162 = west;
            int _e163 = width_5;
            int _e165 = width_5;
            west = ((_e162 + _e163) % _e165);
            c = 0;
            bool loop_init_2 = true;
            while(true) {
                if (!loop_init_2) {
                    int _e246 = c;
                    c = (_e246 + 1);
                }
                loop_init_2 = false;
                int _e168 = c;
                if ((_e168 < 3)) {
                } else {
                    break;
                }
                {
                    int _e171 = start;
                    int _e172 = width_5;
                    int _e175 = top;
                    int _e178 = c;
                    upper_row = ((_e171 + ((3 * _e172) * _e175)) + _e178);
                    int _e180 = start;
                    int _e181 = width_5;
                    int _e184 = bottom_2;
                    int _e187 = c;
                    lower_row = ((_e180 + ((3 * _e181) * _e184)) + _e187);
                    int _e189 = upper_row;
                    int _e190 = west;
                    float _e194 = read_texels((_e189 + (3 * _e190)));
                    float _e195 = right_2;
                    int _e199 = upper_row;
                    int _e200 = east;
                    float _e204 = read_texels((_e199 + (3 * _e200)));
                    float _e205 = right_2;
                    upper = ((_e194 * (1.0 - _e195)) + (_e204 * _e205));
                    int _e208 = lower_row;
                    int _e209 = west;
                    float _e213 = read_texels((_e208 + (3 * _e209)));
                    float _e214 = right_2;
                    int _e218 = lower_row;
                    int _e219 = east;
                    float _e223 = read_texels((_e218 + (3 * _e219)));
                    float _e224 = right_2;
                    lower = ((_e213 * (1.0 - _e214)) + (_e223 * _e224));
                    int _e228 = c;
                    int _e231 = c;
                    float _e233 = reflectance_color[_e231];
                    float _e234 = part_2;
                    float _e235 = upper;
                    float _e236 = down_1;
                    float _e240 = lower;
                    float _e241 = down_1;
                    reflectance_color[_e228] = (_e233 + (_e234 * ((_e235 * (1.0 - _e236)) + (_e240 * _e241))));
                }
            }
        }
    }
    return;
}

vec4 reflectance(float x_20, float y_13, float z_3, float sine_1_3, float impact_2, float cosine_1_2, float angle_2) {
    float across_4 = 0.0;
    float up_3 = 0.0;
    float scale_1 = 0.0;
    float px = 0.0;
    float py = 0.0;
    float pz = 0.0;
    float latitude_1 = 0.0;
    float longitude_1 = 0.0;
    float reach_1 = 0.0;
    float level_2 = 0.0;
    vec4 total = vec4(0.0);
    int c_1 = 0;
    float _e22 = _group_0_binding_0_fs.shell.x;
    float _e27 = _group_0_binding_0_fs.shell.x;
    Several_f32_f32_ _e28 = first_meeting(min(impact_2, _e22), sine_1_3, _e27);
    across_4 = _e28.v0_;
    up_3 = _e28.v1_;
    float _e31 = across_4;
    scale_1 = (_e31 / max(sine_1_3, 1e-30));
    float _e35 = scale_1;
    float now_2_6 = (_e35 * x_20);
    float _e37 = scale_1;
    float now_3_1 = (_e37 * y_13);
    float now_4_ = up_3;
    px = now_2_6;
    py = now_3_1;
    pz = now_4_;
    if ((angle_2 != 0.0)) {
        float _e42 = px;
        float _e43 = py;
        float _e44 = pz;
        float _e48 = _group_0_binding_0_fs.shell.x;
        Several_f32_f32_f32_ _e49 = moved_on(_e42, _e43, _e44, x_20, y_13, z_3, cosine_1_2, angle_2, _e48);
        px = _e49.v0_;
        py = _e49.v1_;
        pz = _e49.v2_;
    }
    float _e56 = _group_0_binding_0_fs.planet_x.x;
    float _e57 = px;
    float _e62 = _group_0_binding_0_fs.planet_x.y;
    float _e63 = py;
    float _e69 = _group_0_binding_0_fs.planet_x.z;
    float _e70 = pz;
    float _e76 = _group_0_binding_0_fs.planet_y.x;
    float _e77 = px;
    float _e82 = _group_0_binding_0_fs.planet_y.y;
    float _e83 = py;
    float _e89 = _group_0_binding_0_fs.planet_y.z;
    float _e90 = pz;
    float _e96 = _group_0_binding_0_fs.planet_z.x;
    float _e97 = px;
    float _e102 = _group_0_binding_0_fs.planet_z.y;
    float _e103 = py;
    float _e109 = _group_0_binding_0_fs.planet_z.z;
    float _e110 = pz;
    Several_f32_f32_ _e113 = latitude_longitude((((_e56 * _e57) + (_e62 * _e63)) + (_e69 * _e70)), (((_e76 * _e77) + (_e82 * _e83)) + (_e89 * _e90)), (((_e96 * _e97) + (_e102 * _e103)) + (_e109 * _e110)));
    latitude_1 = _e113.v0_;
    longitude_1 = _e113.v1_;
    float _e116 = px;
    float _e117 = px;
    float _e119 = py;
    float _e120 = py;
    float _e123 = pz;
    float _e127 = _group_0_binding_0_fs.observer.x;
    float _e129 = pz;
    float _e133 = _group_0_binding_0_fs.observer.x;
    reach_1 = sqrt((((_e116 * _e117) + (_e119 * _e120)) + ((_e123 - _e127) * (_e129 - _e133))));
    float _e141 = _group_0_binding_0_fs.camera_right.w;
    float _e142 = reach_1;
    float _e146 = _group_0_binding_0_fs.shell.x;
    int _e148 = size_levels(1);
    float _e153 = read_levels(((0 * _e148) + 1));
    float _e154 = map_level(_e141, _e142, cosine_1_2, _e146, _e153);
    level_2 = _e154;
    float _e155 = latitude_1;
    float _e156 = longitude_1;
    float _e157 = level_2;
    map_color_1_(_e155, _e156, _e157);
    total = vec4(0.0);
    c_1 = 0;
    bool loop_init_3 = true;
    while(true) {
        if (!loop_init_3) {
            int _e175 = c_1;
            c_1 = (_e175 + 1);
        }
        loop_init_3 = false;
        int _e161 = c_1;
        if ((_e161 < 3)) {
        } else {
            break;
        }
        {
            vec4 _e164 = total;
            int _e165 = c_1;
            vec4 _e168 = read_basis((1 * _e165));
            int _e170 = c_1;
            float _e172 = reflectance_color[_e170];
            total = (_e164 + (_e168 * _e172));
        }
    }
    vec4 _e178 = total;
    return min(max(_e178, vec4(0.0)), vec4(1.0));
}

float altitude_coordinate(float r, float bottom_radius_1, float top_radius_1) {
    float tangent = 0.0;
    tangent = sqrt(((top_radius_1 - bottom_radius_1) * (top_radius_1 + bottom_radius_1)));
    float _e14 = tangent;
    return (sqrt(max(((r - bottom_radius_1) * (r + bottom_radius_1)), 0.0)) / _e14);
}

float chord(float r_1, float mu_1, float radius_1) {
    return sqrt(max((((radius_1 - r_1) * (radius_1 + r_1)) + (((r_1 * r_1) * mu_1) * mu_1)), 0.0));
}

float distance_to_top(float r_2, float mu_2, float top_radius_2) {
    float _e5 = chord(r_2, mu_2, top_radius_2);
    return max(((-(r_2) * mu_2) + _e5), 0.0);
}

float direction_coordinate(float r_3, float mu_3, float bottom_radius_2, float top_radius_3) {
    float shortest = 0.0;
    float longest = 0.0;
    float distance_1_1 = 0.0;
    shortest = (top_radius_3 - r_3);
    longest = (sqrt(max(((r_3 - bottom_radius_2) * (r_3 + bottom_radius_2)), 0.0)) + sqrt(((top_radius_3 - bottom_radius_2) * (top_radius_3 + bottom_radius_2))));
    float _e19 = distance_to_top(r_3, mu_3, top_radius_3);
    distance_1_1 = _e19;
    float _e20 = distance_1_1;
    float _e21 = shortest;
    float _e23 = longest;
    float _e24 = shortest;
    return min(max(((_e20 - _e21) / (_e23 - _e24)), 0.0), 1.0);
}

float bend_angle(float x_21, float mu_4, float bend, float column_4) {
    return (((bend * column_4) * x_21) * sqrt(max(((1.0 - mu_4) * (1.0 + mu_4)), 0.0)));
}

void columns_to_top_1_(float r_4, float mu_5, float bottom_3, float top_1) {
    float x_22 = 0.0;
    int row_4 = 0;
    float f_5 = 0.0;
    int place = 0;
    float e_4 = 0.0;
    float w00_ = 0.0;
    float w01_ = 0.0;
    float w10_ = 0.0;
    float w11_ = 0.0;
    float distance_1_2 = 0.0;
    int c_2 = 0;
    float scale_2 = 0.0;
    float scaled = 0.0;
    float _e17 = altitude_coordinate(r_4, bottom_3, top_1);
    int _e19 = size_columns(0);
    x_22 = (_e17 * float((_e19 - 1)));
    float _e24 = x_22;
    int _e27 = size_columns(0);
    row_4 = min(int(_e24), (_e27 - 2));
    float _e31 = x_22;
    int _e32 = row_4;
    f_5 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_4, mu_5, bottom_3, top_1);
    int _e37 = size_columns(1);
    x_22 = (_e35 * float((_e37 - 1)));
    float _e42 = x_22;
    int _e45 = size_columns(1);
    place = min(int(_e42), (_e45 - 2));
    float _e49 = x_22;
    int _e50 = place;
    e_4 = (_e49 - float(_e50));
    float _e53 = f_5;
    float _e56 = e_4;
    float now_1_5 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_5;
    float _e63 = e_4;
    float now_2_7 = ((1.0 - _e60) * _e63);
    w00_ = now_1_5;
    w01_ = now_2_7;
    float _e65 = f_5;
    float _e66 = e_4;
    float now_3_2 = (_e65 * (1.0 - _e66));
    float _e70 = f_5;
    float _e71 = e_4;
    float now_4_1 = (_e70 * _e71);
    w10_ = now_3_2;
    w11_ = now_4_1;
    float _e73 = distance_to_top(r_4, mu_5, top_1);
    distance_1_2 = _e73;
    c_2 = 0;
    bool loop_init_4 = true;
    while(true) {
        if (!loop_init_4) {
            int _e261 = c_2;
            c_2 = (_e261 + 1);
        }
        loop_init_4 = false;
        int _e75 = c_2;
        int _e77 = size_columns(2);
        if ((_e75 < _e77)) {
        } else {
            break;
        }
        {
            float _e79 = w00_;
            int _e80 = row_4;
            int _e82 = size_columns(1);
            int _e84 = place;
            int _e87 = size_columns(2);
            int _e89 = c_2;
            int _e92 = size_columns(3);
            float _e96 = read_columns(((((((_e80 * _e82) + _e84) * _e87) + _e89) * _e92) + 0));
            float _e98 = w01_;
            int _e99 = row_4;
            int _e101 = size_columns(1);
            int _e103 = place;
            int _e108 = size_columns(2);
            int _e110 = c_2;
            int _e113 = size_columns(3);
            float _e117 = read_columns(((((((_e99 * _e101) + (_e103 + 1)) * _e108) + _e110) * _e113) + 0));
            float _e120 = w10_;
            int _e121 = row_4;
            int _e125 = size_columns(1);
            int _e127 = place;
            int _e130 = size_columns(2);
            int _e132 = c_2;
            int _e135 = size_columns(3);
            float _e139 = read_columns((((((((_e121 + 1) * _e125) + _e127) * _e130) + _e132) * _e135) + 0));
            float _e142 = w11_;
            int _e143 = row_4;
            int _e147 = size_columns(1);
            int _e149 = place;
            int _e154 = size_columns(2);
            int _e156 = c_2;
            int _e159 = size_columns(3);
            float _e163 = read_columns((((((((_e143 + 1) * _e147) + (_e149 + 1)) * _e154) + _e156) * _e159) + 0));
            scale_2 = ((((_e79 * _e96) + (_e98 * _e117)) + (_e120 * _e139)) + (_e142 * _e163));
            float _e166 = w00_;
            int _e167 = row_4;
            int _e169 = size_columns(1);
            int _e171 = place;
            int _e174 = size_columns(2);
            int _e176 = c_2;
            int _e179 = size_columns(3);
            float _e183 = read_columns(((((((_e167 * _e169) + _e171) * _e174) + _e176) * _e179) + 1));
            float _e185 = w01_;
            int _e186 = row_4;
            int _e188 = size_columns(1);
            int _e190 = place;
            int _e195 = size_columns(2);
            int _e197 = c_2;
            int _e200 = size_columns(3);
            float _e204 = read_columns(((((((_e186 * _e188) + (_e190 + 1)) * _e195) + _e197) * _e200) + 1));
            float _e207 = w10_;
            int _e208 = row_4;
            int _e212 = size_columns(1);
            int _e214 = place;
            int _e217 = size_columns(2);
            int _e219 = c_2;
            int _e222 = size_columns(3);
            float _e226 = read_columns((((((((_e208 + 1) * _e212) + _e214) * _e217) + _e219) * _e222) + 1));
            float _e229 = w11_;
            int _e230 = row_4;
            int _e234 = size_columns(1);
            int _e236 = place;
            int _e241 = size_columns(2);
            int _e243 = c_2;
            int _e246 = size_columns(3);
            float _e250 = read_columns((((((((_e230 + 1) * _e234) + (_e236 + 1)) * _e241) + _e243) * _e246) + 1));
            scaled = ((((_e166 * _e183) + (_e185 * _e204)) + (_e207 * _e226)) + (_e229 * _e250));
            int _e254 = c_2;
            float _e256 = distance_1_2;
            float _e257 = scaled;
            float _e259 = scale_2;
            star_disc_here[_e254] = ((_e256 * _e257) / _e259);
        }
    }
    return;
}

vec4 through_columns_1_(int constituents) {
    vec4 tau = vec4(0.0);
    int c_3 = 0;
    tau = vec4(0.0);
    c_3 = 0;
    bool loop_init_5 = true;
    while(true) {
        if (!loop_init_5) {
            int _e21 = c_3;
            c_3 = (_e21 + 1);
        }
        loop_init_5 = false;
        int _e6 = c_3;
        if ((_e6 < constituents)) {
        } else {
            break;
        }
        {
            vec4 _e8 = tau;
            int _e9 = c_3;
            vec4 _e14 = read_extinction(((1 * _e9) + 0));
            int _e16 = c_3;
            float _e18 = star_disc_here[_e16];
            tau = (_e8 + (_e14 * _e18));
        }
    }
    vec4 _e24 = tau;
    return exp((vec4(0.0) - _e24));
}

vec4 star_disc(float x_23, float y_14, float z_4, float start_r, float start_mu, bool inside) {
    vec4 through = vec4(0.0);
    float lx = 0.0;
    float ly = 0.0;
    float lz = 0.0;
    float angle_3 = 0.0;
    float level_3 = 0.0;
    float turn = 0.0;
    float keep_1 = 0.0;
    float scale_3 = 0.0;
    float apart = 0.0;
    float wide = 0.0;
    float covered = 0.0;
    float share = 0.0;
    through = vec4(1.0);
    lx = x_23;
    ly = y_14;
    lz = z_4;
    if (inside) {
        float _e24 = _group_0_binding_0_fs.shell.x;
        float _e28 = _group_0_binding_0_fs.shell.y;
        columns_to_top_1_(start_r, start_mu, _e24, _e28);
        float _e32 = _group_0_binding_0_fs.counts.x;
        vec4 _e34 = through_columns_1_(int(_e32));
        through = _e34;
        float _e38 = _group_0_binding_0_fs.shell.w;
        if ((_e38 > 0.0)) {
            float _e44 = _group_0_binding_0_fs.shell.w;
            float _e49 = _group_0_binding_0_fs.counts.x;
            float _e54 = star_disc_here[(int(_e49) - 1)];
            float _e55 = bend_angle(start_r, start_mu, _e44, _e54);
            angle_3 = _e55;
            level_3 = sqrt(((x_23 * x_23) + (y_14 * y_14)));
            float _e60 = angle_3;
            float _e61 = sine(_e60);
            float _e62 = angle_3;
            float _e63 = cosine(_e62);
            turn = _e61;
            keep_1 = _e63;
            float _e64 = keep_1;
            float _e66 = level_3;
            float _e67 = turn;
            lz = ((z_4 * _e64) - (_e66 * _e67));
            float _e70 = level_3;
            float _e71 = keep_1;
            float _e73 = turn;
            float _e76 = level_3;
            scale_3 = (((_e70 * _e71) + (z_4 * _e73)) / max(_e76, 1e-30));
            float _e80 = scale_3;
            float now_6_1 = (x_23 * _e80);
            float _e82 = scale_3;
            float now_7_1 = (y_14 * _e82);
            lx = now_6_1;
            ly = now_7_1;
        }
    }
    float _e84 = lx;
    float _e85 = ly;
    float _e86 = lz;
    float _e90 = _group_0_binding_0_fs.star.x;
    float _e94 = _group_0_binding_0_fs.star.y;
    float _e95 = half_sine_between(_e84, _e85, _e86, _e90, _e94);
    apart = (2.0 * _e95);
    float _e101 = _group_0_binding_0_fs.shell.z;
    float _e105 = _group_0_binding_0_fs.camera_right.w;
    wide = max(_e101, (0.75 * _e105));
    float _e109 = wide;
    float _e110 = apart;
    float _e115 = _group_0_binding_0_fs.camera_right.w;
    covered = min(max((((_e109 - _e110) / _e115) + 0.5), 0.0), 1.0);
    float _e126 = _group_0_binding_0_fs.shell.z;
    float _e127 = wide;
    share = (_e126 / _e127);
    vec4 _e129 = through;
    float _e130 = covered;
    float _e131 = share;
    float _e133 = share;
    float _e138 = _group_0_binding_0_fs.camera_up.w;
    return (_e129 * (((_e130 * _e131) * _e133) * _e138));
}

float physical_light(float light) {
    return min(((light > 0.0) ? light : 0.0), 1e18);
}

float exponential_curve(float x_24) {
    return (1.0 - exp(-(x_24)));
}

float exponential_shown(float light_1) {
    float _e1 = physical_light(light_1);
    float _e2 = exponential_curve(_e1);
    return _e2;
}

float hable_curve(float light_2) {
    float x_25 = 0.0;
    float curve = 0.0;
    x_25 = (2.0 * light_2);
    float _e5 = x_25;
    float _e6 = x_25;
    x_25 = ((_e6 < 11.2) ? _e5 : 11.2);
    float _e11 = x_25;
    float _e12 = x_25;
    float _e20 = x_25;
    float _e21 = x_25;
    curve = ((((_e11 * ((0.15 * _e12) + 0.05)) + 0.004) / ((_e20 * ((0.15 * _e21) + 0.5)) + 0.06)) - 0.06666667);
    float _e32 = curve;
    return (_e32 / 0.72512937);
}

float hable_shown(float light_3) {
    float _e1 = physical_light(light_3);
    float _e2 = hable_curve(_e1);
    return max(_e2, 0.0);
}

float luminance_of(float red, float green, float blue) {
    return (((0.21267284 * red) + (0.71515214 * green)) + (0.072174996 * blue));
}

Several_f32_f32_f32_ reinhard_color(float red_1, float green_1, float blue_1) {
    float r_5 = 0.0;
    float g_4 = 0.0;
    float b = 0.0;
    float darkening = 0.0;
    float _e7 = physical_light(red_1);
    float _e8 = physical_light(green_1);
    float _e9 = physical_light(blue_1);
    r_5 = _e7;
    g_4 = _e8;
    b = _e9;
    float _e10 = r_5;
    float _e11 = g_4;
    float _e12 = b;
    float _e13 = luminance_of(_e10, _e11, _e12);
    darkening = (1.0 / (1.0 + _e13));
    float _e18 = r_5;
    float _e19 = darkening;
    float _e21 = g_4;
    float _e22 = darkening;
    float _e24 = b;
    float _e25 = darkening;
    return Several_f32_f32_f32_((_e18 * _e19), (_e21 * _e22), (_e24 * _e25));
}

Several_f32_f32_f32_ reinhard_extended_color(float red_2, float green_2, float blue_2, float white) {
    float r_6 = 0.0;
    float g_5 = 0.0;
    float b_1 = 0.0;
    float bright = 0.0;
    float darkening_1 = 0.0;
    float _e9 = physical_light(red_2);
    float _e10 = physical_light(green_2);
    float _e11 = physical_light(blue_2);
    r_6 = _e9;
    g_5 = _e10;
    b_1 = _e11;
    float _e12 = r_6;
    float _e13 = g_5;
    float _e14 = b_1;
    float _e15 = luminance_of(_e12, _e13, _e14);
    bright = _e15;
    float _e16 = bright;
    float _e21 = bright;
    darkening_1 = ((1.0 + (_e16 / (white * white))) / (1.0 + _e21));
    float _e25 = r_6;
    float _e26 = darkening_1;
    float _e28 = g_5;
    float _e29 = darkening_1;
    float _e31 = b_1;
    float _e32 = darkening_1;
    return Several_f32_f32_f32_((_e25 * _e26), (_e28 * _e29), (_e31 * _e32));
}

float aces_curve(float x_26) {
    return (((x_26 * (x_26 + 0.0245786)) - 9.0537e-5) / ((x_26 * ((0.983729 * x_26) + 0.432951)) + 0.238081));
}

Several_f32_f32_f32_ aces_color(float red_3, float green_3, float blue_3) {
    float r_7 = 0.0;
    float g_6 = 0.0;
    float b_2 = 0.0;
    float x_27 = 0.0;
    float y_15 = 0.0;
    float z_5 = 0.0;
    float _e9 = physical_light(red_3);
    float _e10 = physical_light(green_3);
    float _e11 = physical_light(blue_3);
    r_7 = _e9;
    g_6 = _e10;
    b_2 = _e11;
    float _e12 = r_7;
    float _e15 = g_6;
    float _e19 = b_2;
    float _e23 = aces_curve((((0.59719 * _e12) + (0.35458 * _e15)) + (0.04823 * _e19)));
    x_27 = _e23;
    float _e24 = r_7;
    float _e27 = g_6;
    float _e31 = b_2;
    float _e35 = aces_curve((((0.076 * _e24) + (0.90834 * _e27)) + (0.01566 * _e31)));
    y_15 = _e35;
    float _e36 = r_7;
    float _e39 = g_6;
    float _e43 = b_2;
    float _e47 = aces_curve((((0.0284 * _e36) + (0.13383 * _e39)) + (0.83777 * _e43)));
    z_5 = _e47;
    float _e48 = x_27;
    float _e51 = y_15;
    float _e55 = z_5;
    float _e63 = x_27;
    float _e66 = y_15;
    float _e70 = z_5;
    float _e78 = x_27;
    float _e81 = y_15;
    float _e85 = z_5;
    return Several_f32_f32_f32_(min(max((((1.60475 * _e48) + (-0.53108 * _e51)) + (-0.07367 * _e55)), 0.0), 1.0), min(max((((-0.10208 * _e63) + (1.10813 * _e66)) + (-0.00605 * _e70)), 0.0), 1.0), min(max((((-0.00327 * _e78) + (-0.07276 * _e81)) + (1.07602 * _e85)), 0.0), 1.0));
}

float agx_curve(float light_4) {
    float least = 0.0;
    float x_28 = 0.0;
    float t = 0.0;
    float y_16 = 0.0;
    least = 0.00017578126;
    float _e6 = least;
    float _e7 = least;
    x_28 = (((log2((((light_4 > _e7) ? light_4 : _e6) / 0.18)) - -10.0) / 16.5) - 0.6060606);
    float _e19 = x_28;
    float _e20 = x_28;
    x_28 = ((_e20 < 0.3939394) ? _e19 : 0.3939394);
    float _e25 = x_28;
    if ((_e25 < 0.0)) {
        float _e28 = x_28;
        t = ((-2.0 * _e28) / 0.51227736);
        float _e33 = t;
        float _e36 = t;
        float _e37 = cubed(_e36);
        y_16 = (0.5 - ((0.51227736 * _e33) / pow((1.0 + _e37), 0.33333334)));
    } else {
        float _e45 = x_28;
        t = ((2.0 * _e45) / 0.54146415);
        float _e50 = t;
        float _e53 = t;
        y_16 = (0.5 + ((0.54146415 * _e50) / pow((1.0 + pow(_e53, 3.25)), 0.30769232)));
    }
    float _e63 = y_16;
    float _e64 = y_16;
    return ((_e64 > 0.0) ? _e63 : 0.0);
}

Several_f32_f32_f32_ agx_color(float red_4, float green_4, float blue_4) {
    float r_8 = 0.0;
    float g_7 = 0.0;
    float b_3 = 0.0;
    float x_29 = 0.0;
    float y_17 = 0.0;
    float z_6 = 0.0;
    float _e9 = physical_light(red_4);
    float _e10 = physical_light(green_4);
    float _e11 = physical_light(blue_4);
    r_8 = _e9;
    g_7 = _e10;
    b_3 = _e11;
    float _e12 = r_8;
    float _e15 = g_7;
    float _e19 = b_3;
    float _e23 = agx_curve((((0.84247905 * _e12) + (0.0784336 * _e15)) + (0.079223745 * _e19)));
    x_29 = _e23;
    float _e24 = r_8;
    float _e27 = g_7;
    float _e31 = b_3;
    float _e35 = agx_curve((((0.042328242 * _e24) + (0.87846863 * _e27)) + (0.07916613 * _e31)));
    y_17 = _e35;
    float _e36 = r_8;
    float _e39 = g_7;
    float _e43 = b_3;
    float _e47 = agx_curve((((0.042375654 * _e36) + (0.0784336 * _e39)) + (0.879143 * _e43)));
    z_6 = _e47;
    float _e48 = x_29;
    float _e51 = y_17;
    float _e55 = z_6;
    float _e65 = x_29;
    float _e68 = y_17;
    float _e72 = z_6;
    float _e82 = x_29;
    float _e85 = y_17;
    float _e89 = z_6;
    return Several_f32_f32_f32_(pow(min(max((((1.196879 * _e48) + (-0.09802088 * _e51)) + (-0.09902974 * _e55)), 0.0), 1.0), 2.2), pow(min(max((((-0.052896854 * _e65) + (1.1519032 * _e68)) + (-0.098961174 * _e72)), 0.0), 1.0), 2.2), pow(min(max((((-0.052971635 * _e82) + (-0.09804345 * _e85)) + (1.1510737 * _e89)), 0.0), 1.0), 2.2));
}

Several_f32_f32_f32_ tone_mapped(int which_1, float red_5, float green_5, float blue_5) {
    if ((which_1 == 0)) {
        float _e6 = exponential_shown(red_5);
        float _e7 = exponential_shown(green_5);
        float _e8 = exponential_shown(blue_5);
        return Several_f32_f32_f32_(_e6, _e7, _e8);
    }
    if ((which_1 == 1)) {
        float _e12 = hable_shown(red_5);
        float _e13 = hable_shown(green_5);
        float _e14 = hable_shown(blue_5);
        return Several_f32_f32_f32_(_e12, _e13, _e14);
    }
    if ((which_1 == 2)) {
        Several_f32_f32_f32_ _e18 = reinhard_color(red_5, green_5, blue_5);
        return _e18;
    }
    if ((which_1 == 3)) {
        Several_f32_f32_f32_ _e22 = reinhard_extended_color(red_5, green_5, blue_5, 4.0);
        return _e22;
    }
    if ((which_1 == 4)) {
        Several_f32_f32_f32_ _e25 = aces_color(red_5, green_5, blue_5);
        return _e25;
    }
    Several_f32_f32_f32_ _e26 = agx_color(red_5, green_5, blue_5);
    return _e26;
}

float srgb_curve(float linear) {
    float positive = 0.0;
    positive = ((linear > 0.0) ? linear : 0.0);
    float _e6 = positive;
    if ((_e6 <= 0.0031308)) {
        float _e9 = positive;
        return (12.92 * _e9);
    }
    float _e12 = positive;
    return ((1.055 * pow(_e12, 0.41666666)) - 0.055);
}

float gamma_curve(float linear_1) {
    float positive_1 = 0.0;
    positive_1 = ((linear_1 > 0.0) ? linear_1 : 0.0);
    float _e6 = positive_1;
    return pow(_e6, 0.45454547);
}

float encoded(int which_2, float linear_2) {
    if ((which_2 == 0)) {
        float _e4 = srgb_curve(linear_2);
        return _e4;
    }
    float _e5 = gamma_curve(linear_2);
    return _e5;
}

void light_of_pixel_1_(float px_1, float py_1) {
    float right_3 = 0.0;
    float above_1 = 0.0;
    float ahead = 0.0;
    float x_30 = 0.0;
    float y_18 = 0.0;
    float z_7 = 0.0;
    vec4 total_1 = vec4(0.0);
    float sine_1_4 = 0.0;
    float impact_3 = 0.0;
    float angle_up = 0.0;
    bool to_ground = false;
    bool inside_1 = false;
    float row_5 = 0.0;
    bool shown = false;
    float start_r_1 = 0.0;
    float start_mu_1 = 0.0;
    float cos_azimuth = 0.0;
    float half_sine_1 = 0.0;
    vec4 ground = vec4(0.0);
    float bent = 0.0;
    int columns_4 = 0;
    int rows_5 = 0;
    float azimuth_5 = 0.0;
    vec4 albedo = vec4(0.0);
    float cosine_1_3 = 0.0;
    bool local_1 = false;
    bool local_2 = false;
    bool local_3 = false;
    bool local_4 = false;
    bool local_5 = false;
    bool local_6 = false;
    float _e30 = _group_0_binding_0_fs.screen.w;
    float _e35 = _group_0_binding_0_fs.screen.x;
    float _e39 = _group_0_binding_0_fs.screen.y;
    float _e43 = _group_0_binding_0_fs.screen.z;
    Several_f32_f32_f32_ _e44 = projected_ray(int(_e30), px_1, py_1, _e35, _e39, _e43);
    right_3 = _e44.v0_;
    above_1 = _e44.v1_;
    ahead = _e44.v2_;
    float _e48 = right_3;
    float _e52 = _group_0_binding_0_fs.camera_right.x;
    float _e54 = above_1;
    float _e58 = _group_0_binding_0_fs.camera_up.x;
    float _e61 = ahead;
    float _e65 = _group_0_binding_0_fs.camera_forward.x;
    x_30 = (((_e48 * _e52) + (_e54 * _e58)) + (_e61 * _e65));
    float _e68 = right_3;
    float _e72 = _group_0_binding_0_fs.camera_right.y;
    float _e74 = above_1;
    float _e78 = _group_0_binding_0_fs.camera_up.y;
    float _e81 = ahead;
    float _e85 = _group_0_binding_0_fs.camera_forward.y;
    y_18 = (((_e68 * _e72) + (_e74 * _e78)) + (_e81 * _e85));
    float _e88 = right_3;
    float _e92 = _group_0_binding_0_fs.camera_right.z;
    float _e94 = above_1;
    float _e98 = _group_0_binding_0_fs.camera_up.z;
    float _e101 = ahead;
    float _e105 = _group_0_binding_0_fs.camera_forward.z;
    z_7 = (((_e88 * _e92) + (_e94 * _e98)) + (_e101 * _e105));
    total_1 = vec4(0.0);
    float _e110 = x_30;
    float _e111 = x_30;
    float _e113 = y_18;
    float _e114 = y_18;
    sine_1_4 = sqrt(((_e110 * _e111) + (_e113 * _e114)));
    float _e121 = _group_0_binding_0_fs.observer.x;
    float _e122 = sine_1_4;
    impact_3 = (_e121 * _e122);
    float _e124 = z_7;
    float _e125 = sine_1_4;
    float _e129 = _group_0_binding_0_fs.observer.z;
    float _e133 = _group_0_binding_0_fs.observer.w;
    float _e134 = angle_above_horizon(_e124, _e125, _e129, _e133);
    angle_up = _e134;
    float _e135 = angle_up;
    to_ground = (_e135 < 0.0);
    inside_1 = true;
    float _e139 = angle_up;
    float _e143 = _group_0_binding_0_fs.observer.z;
    float _e144 = row_from_angle(_e139, _e143);
    row_5 = _e144;
    float _e148 = _group_0_binding_0_fs.observer.y;
    if ((_e148 > 0.5)) {
        float _e151 = z_7;
        if ((_e151 < 0.0)) {
            float _e156 = impact_3;
            float _e160 = _group_0_binding_0_fs.shell.y;
            local_1 = (_e156 < _e160);
        } else {
            local_1 = false;
        }
        bool _e163 = local_1;
        inside_1 = _e163;
        bool _e164 = inside_1;
        if (_e164) {
            float _e167 = impact_3;
            float _e171 = _group_0_binding_0_fs.shell.x;
            local_2 = (_e167 < _e171);
        } else {
            local_2 = false;
        }
        bool _e174 = local_2;
        to_ground = _e174;
        float _e175 = impact_3;
        float _e179 = _group_0_binding_0_fs.shell.x;
        float _e183 = _group_0_binding_0_fs.shell.y;
        float _e184 = row_from_impact(_e175, _e179, _e183);
        row_5 = _e184;
    }
    float _e185 = right_3;
    if (!((_e185 != 0.0))) {
        float _e191 = above_1;
        local_3 = (_e191 != 0.0);
    } else {
        local_3 = true;
    }
    bool _e195 = local_3;
    if (!(_e195)) {
        float _e199 = ahead;
        local_4 = (_e199 != 0.0);
    } else {
        local_4 = true;
    }
    bool _e203 = local_4;
    shown = _e203;
    float now_2_8 = _group_0_binding_0_fs.observer.x;
    float now_3_3 = z_7;
    start_r_1 = now_2_8;
    start_mu_1 = now_3_3;
    float _e212 = _group_0_binding_0_fs.observer.y;
    if ((_e212 > 0.5)) {
        float _e218 = _group_0_binding_0_fs.shell.y;
        start_r_1 = _e218;
        float _e222 = _group_0_binding_0_fs.shell.y;
        float _e223 = impact_3;
        float _e228 = _group_0_binding_0_fs.shell.y;
        float _e229 = impact_3;
        float _e239 = _group_0_binding_0_fs.shell.y;
        start_mu_1 = (-(sqrt(max(((_e222 - _e223) * (_e228 + _e229)), 0.0))) / _e239);
    }
    bool _e241 = shown;
    if (_e241) {
        bool _e244 = inside_1;
        local_5 = _e244;
    } else {
        local_5 = false;
    }
    bool _e246 = local_5;
    if (_e246) {
        float _e247 = x_30;
        float _e248 = sine_1_4;
        float _e250 = sine_1_4;
        cos_azimuth = ((_e250 > 0.0) ? (_e247 / _e248) : 1.0);
        float _e255 = x_30;
        float _e256 = y_18;
        float _e257 = z_7;
        float _e261 = _group_0_binding_0_fs.star.z;
        float _e265 = _group_0_binding_0_fs.star.w;
        float _e266 = half_sine_between(_e255, _e256, _e257, _e261, _e265);
        half_sine_1 = _e266;
        ground = vec4(0.0);
        bent = 0.0;
        float _e273 = _group_0_binding_0_fs.sky.x;
        int now_4_2 = int(_e273);
        float _e278 = _group_0_binding_0_fs.sky.y;
        int now_5_1 = int(_e278);
        columns_4 = now_4_2;
        rows_5 = now_5_1;
        float _e280 = y_18;
        float _e282 = x_30;
        azimuth_5 = (atan(abs(_e280), _e282) / 3.1415927);
        int _e286 = columns_4;
        int _e287 = rows_5;
        float _e288 = row_5;
        bool _e289 = to_ground;
        float _e291 = azimuth_5;
        vec4 _e292 = between_texels(_e286, _e287, _e288, !(_e289), _e291);
        total_1 = _e292;
        bool _e293 = to_ground;
        if (_e293) {
            int _e294 = columns_4;
            int _e295 = rows_5;
            float _e296 = row_5;
            float _e297 = azimuth_5;
            vec4 _e298 = between_texels_2_(_e294, _e295, _e296, _e297);
            ground = _e298;
        }
        float _e302 = _group_0_binding_0_fs.peaks.y;
        if ((int(_e302) >= 0)) {
            vec4 _e306 = total_1;
            float _e307 = half_sine_1;
            float _e311 = _group_0_binding_0_fs.peaks.y;
            vec4 _e313 = phase_of(_e307, int(_e311));
            int _e314 = columns_4;
            int _e315 = rows_5;
            float _e316 = row_5;
            bool _e317 = to_ground;
            float _e319 = azimuth_5;
            vec4 _e320 = between_texels_3_(_e314, _e315, _e316, !(_e317), _e319);
            total_1 = (_e306 + (_e313 * _e320));
        }
        float _e326 = _group_0_binding_0_fs.peaks.z;
        if ((int(_e326) >= 0)) {
            vec4 _e330 = total_1;
            float _e331 = half_sine_1;
            float _e335 = _group_0_binding_0_fs.peaks.z;
            vec4 _e337 = phase_of(_e331, int(_e335));
            int _e338 = columns_4;
            int _e339 = rows_5;
            float _e340 = row_5;
            bool _e341 = to_ground;
            float _e343 = azimuth_5;
            vec4 _e344 = between_texels_4_(_e338, _e339, _e340, !(_e341), _e343);
            total_1 = (_e330 + (_e337 * _e344));
        }
        bool _e347 = to_ground;
        if (_e347) {
            vec4 _e349 = read_albedo(0);
            albedo = _e349;
            float _e353 = _group_0_binding_0_fs.planet_x.w;
            if ((_e353 > 0.5)) {
                float _e359 = _group_0_binding_0_fs.shell.x;
                float _e360 = impact_3;
                float _e365 = _group_0_binding_0_fs.shell.x;
                float _e366 = impact_3;
                cosine_1_3 = sqrt(max(((_e359 - _e360) * (_e365 + _e366)), 0.0));
                float _e372 = cosine_1_3;
                float _e376 = _group_0_binding_0_fs.shell.x;
                cosine_1_3 = (_e372 / _e376);
                float _e378 = x_30;
                float _e379 = y_18;
                float _e380 = z_7;
                float _e381 = sine_1_4;
                float _e382 = impact_3;
                float _e383 = cosine_1_3;
                float _e384 = bent;
                vec4 _e385 = reflectance(_e378, _e379, _e380, _e381, _e382, _e383, _e384);
                albedo = _e385;
            }
            vec4 _e386 = total_1;
            vec4 _e387 = ground;
            vec4 _e388 = albedo;
            total_1 = (_e386 + (_e387 * _e388));
        }
    }
    bool _e391 = shown;
    if (_e391) {
        float _e397 = _group_0_binding_0_fs.planet_z.w;
        local_6 = (_e397 > 0.5);
    } else {
        local_6 = false;
    }
    bool _e401 = local_6;
    if (_e401) {
        bool _e402 = to_ground;
        if (!(_e402)) {
            vec4 _e404 = total_1;
            float _e405 = x_30;
            float _e406 = y_18;
            float _e407 = z_7;
            float _e408 = start_r_1;
            float _e409 = start_mu_1;
            bool _e410 = inside_1;
            vec4 _e411 = star_disc(_e405, _e406, _e407, _e408, _e409, _e410);
            total_1 = (_e404 + _e411);
        }
    }
    vec4 _e415 = total_1;
    light_of_found[0] = _e415;
    return;
}

vec3 light_of(vec4 at_3) {
    float _e6 = _group_0_binding_0_fs.display.w;
    light_of_pixel_1_(at_3.x, (at_3.y + _e6));
    vec4 _e10 = light_of_found[0];
    vec4 _e13 = _group_0_binding_0_fs.red;
    vec4 _e17 = light_of_found[0];
    vec4 _e20 = _group_0_binding_0_fs.green;
    vec4 _e24 = light_of_found[0];
    vec4 _e27 = _group_0_binding_0_fs.blue;
    return vec3(dot(_e10, _e13), dot(_e17, _e20), dot(_e24, _e27));
}

void main() {
    vec4 at_1 = gl_FragCoord;
    vec3 _e1 = light_of(at_1);
    float _e5 = _group_0_binding_0_fs.display.x;
    vec3 light_5 = (_e1 * _e5);
    float _e10 = _group_0_binding_0_fs.display.y;
    Several_f32_f32_f32_ _e15 = tone_mapped(int(_e10), light_5.x, light_5.y, light_5.z);
    float _e19 = _group_0_binding_0_fs.display.z;
    int kind = int(_e19);
    if ((kind < 0)) {
        _fs2p_location0 = vec4(_e15.v0_, _e15.v1_, _e15.v2_, 1.0);
        return;
    }
    float _e29 = encoded(kind, _e15.v0_);
    float _e31 = encoded(kind, _e15.v1_);
    float _e33 = encoded(kind, _e15.v2_);
    _fs2p_location0 = vec4(_e29, _e31, _e33, 1.0);
    return;
}
