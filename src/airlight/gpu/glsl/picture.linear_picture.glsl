#version 300 es
// of picture.wgsl 48a13ec35980241f, by naga-wasm@30.1.0
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
struct Several_f32_f32_f32_bool {
    float v0_;
    float v1_;
    float v2_;
    bool v3_;
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

float point_like_steps[15];

float point_like_fits[5];

float point_like_columns[8];

float star_disc_columns[8];

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
    float y_24 = (x_2 * x_2);
    return (x_2 + ((x_2 * y_24) * (-0.16666655 + (y_24 * (0.008332161 - (0.00019515296 * y_24))))));
}

float cosine_of_quarter(float x_3) {
    float y_25 = (x_3 * x_3);
    float tail = ((y_25 * y_25) * (0.041666646 + (y_25 * (-0.0013887316 + (2.4433157e-5 * y_25)))));
    return ((1.0 - (0.5 * y_25)) + tail);
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
    float b_7 = abs(y);
    float slope_1 = (min(a_3, b_7) / max(max(a_3, b_7), 1e-37));
    bool steep = (slope_1 > 0.41421357);
    float t_1 = (steep ? ((slope_1 - 1.0) / (slope_1 + 1.0)) : slope_1);
    float z_12 = (t_1 * t_1);
    float tail_1 = (-0.3333295 + (z_12 * (0.19977711 + (z_12 * (-0.13877685 + (z_12 * 0.080537446))))));
    float part_5 = ((steep ? 0.7853982 : 0.0) + (t_1 + ((t_1 * z_12) * tail_1)));
    float quarter_2 = ((b_7 > a_3) ? (1.5707964 - part_5) : part_5);
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

Several_f32_f32_f32_ perspective_ray(float x_11, float y_1, float width, float height, float field_of_view) {
    float slope = 0.0;
    float right = 0.0;
    float up = 0.0;
    float length_1_ = 0.0;
    float _e11 = sine((0.5 * field_of_view));
    float _e14 = cosine((0.5 * field_of_view));
    slope = (_e11 / _e14);
    float _e20 = slope;
    right = ((((2.0 * x_11) - width) / width) * _e20);
    float _e26 = slope;
    up = (((height - (2.0 * y_1)) / width) * _e26);
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

Several_f32_f32_f32_ fisheye_ray(float x_12, float y_2, float width_1, float height_1, float field_of_view_1) {
    float diameter = 0.0;
    float across = 0.0;
    float up_1 = 0.0;
    float square = 0.0;
    float distance_1_ = 0.0;
    float theta = 0.0;
    float scale = 0.0;
    diameter = min(width_1, height_1);
    across = ((2.0 * x_12) - width_1);
    up_1 = (height_1 - (2.0 * y_2));
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

Several_f32_f32_f32_ panorama_ray(float x_13, float y_3, float width_2, float height_2, float field_of_view_2) {
    float azimuth = 0.0;
    float elevation = 0.0;
    float level = 0.0;
    azimuth = (6.2831855 * ((x_13 / width_2) - 0.5));
    elevation = (3.1415927 * (0.5 - (y_3 / height_2)));
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

Several_f32_f32_f32_ cube_ray(float x_14, float y_4, float width_3, float height_3, float field_of_view_3) {
    int face = 0;
    float across_1 = 0.0;
    float above = 0.0;
    float right_1 = 0.0;
    float up_2 = 0.0;
    float forward = 0.0;
    float length_1_1 = 0.0;
    face = min(max(int(floor((x_14 / height_3))), 0), 5);
    int _e20 = face;
    across_1 = ((2.0 * ((x_14 / height_3) - float(_e20))) - 1.0);
    above = (1.0 - ((2.0 * y_4) / height_3));
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

Several_f32_f32_f32_ projected_ray(int projection, float x_15, float y_5, float width_4, float height_4, float field_of_view_4) {
    if ((projection == 0)) {
        Several_f32_f32_f32_ _e8 = perspective_ray(x_15, y_5, width_4, height_4, field_of_view_4);
        return _e8;
    }
    if ((projection == 1)) {
        Several_f32_f32_f32_ _e11 = fisheye_ray(x_15, y_5, width_4, height_4, field_of_view_4);
        return _e11;
    }
    if ((projection == 2)) {
        Several_f32_f32_f32_ _e14 = panorama_ray(x_15, y_5, width_4, height_4, field_of_view_4);
        return _e14;
    }
    Several_f32_f32_f32_ _e15 = cube_ray(x_15, y_5, width_4, height_4, field_of_view_4);
    return _e15;
}

Several_f32_f32_f32_ camera_direction(float px, float py) {
    float right_2 = 0.0;
    float above_1 = 0.0;
    float ahead = 0.0;
    float x_16 = 0.0;
    float y_6 = 0.0;
    float z = 0.0;
    float _e11 = _group_0_binding_0_fs.screen.w;
    float _e16 = _group_0_binding_0_fs.screen.x;
    float _e20 = _group_0_binding_0_fs.screen.y;
    float _e24 = _group_0_binding_0_fs.screen.z;
    Several_f32_f32_f32_ _e25 = projected_ray(int(_e11), px, py, _e16, _e20, _e24);
    right_2 = _e25.v0_;
    above_1 = _e25.v1_;
    ahead = _e25.v2_;
    float _e29 = right_2;
    float _e33 = _group_0_binding_0_fs.camera_right.x;
    float _e35 = above_1;
    float _e39 = _group_0_binding_0_fs.camera_up.x;
    float _e42 = ahead;
    float _e46 = _group_0_binding_0_fs.camera_forward.x;
    x_16 = (((_e29 * _e33) + (_e35 * _e39)) + (_e42 * _e46));
    float _e49 = right_2;
    float _e53 = _group_0_binding_0_fs.camera_right.y;
    float _e55 = above_1;
    float _e59 = _group_0_binding_0_fs.camera_up.y;
    float _e62 = ahead;
    float _e66 = _group_0_binding_0_fs.camera_forward.y;
    y_6 = (((_e49 * _e53) + (_e55 * _e59)) + (_e62 * _e66));
    float _e69 = right_2;
    float _e73 = _group_0_binding_0_fs.camera_right.z;
    float _e75 = above_1;
    float _e79 = _group_0_binding_0_fs.camera_up.z;
    float _e82 = ahead;
    float _e86 = _group_0_binding_0_fs.camera_forward.z;
    z = (((_e69 * _e73) + (_e75 * _e79)) + (_e82 * _e86));
    float _e89 = x_16;
    float _e90 = y_6;
    float _e91 = z;
    return Several_f32_f32_f32_(_e89, _e90, _e91);
}

float angle_above_horizon(float mu, float sine_1_, float horizon_mu, float horizon_sine) {
    float across_2 = 0.0;
    across_2 = ((mu * horizon_sine) - (sine_1_ * horizon_mu));
    float _e8 = across_2;
    float _e12 = angle_of(_e8, ((mu * horizon_mu) + (sine_1_ * horizon_sine)));
    return _e12;
}

float row_from_angle(float angle, float horizon_mu_1) {
    float highest = 0.0;
    float part = 0.0;
    float _e4 = arc_cosine(horizon_mu_1);
    highest = _e4;
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

float half_sine_between(float x_17, float y_7, float z_1, float sun_x, float sun_z) {
    float across_3 = 0.0;
    across_3 = (((x_17 - sun_x) * (x_17 - sun_x)) + (y_7 * y_7));
    float _e11 = across_3;
    return min((0.5 * sqrt((_e11 + ((z_1 - sun_z) * (z_1 - sun_z))))), 1.0);
}

vec4 between_texels(int columns, int rows, float row, bool sky, float azimuth_1) {
    float x_18 = 0.0;
    int column = 0;
    float e = 0.0;
    float y_8 = 0.0;
    int line = 0;
    float f = 0.0;
    float g = 0.0;
    float h = 0.0;
    int near = 0;
    int far = 0;
    vec4 root = vec4(0.0);
    vec4 square_1 = vec4(0.0);
    x_18 = (min(max(azimuth_1, 0.0), 1.0) * float((columns - 1)));
    float _e25 = x_18;
    column = min(int(_e25), (columns - 2));
    float _e30 = x_18;
    int _e31 = column;
    e = (_e30 - float(_e31));
    y_8 = (row * float((rows - 1)));
    float _e38 = y_8;
    line = min(int(_e38), (rows - 2));
    float _e43 = y_8;
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
    float x_19 = 0.0;
    int column_1 = 0;
    float e_1 = 0.0;
    float y_9 = 0.0;
    int line_1 = 0;
    float f_1 = 0.0;
    float g_1 = 0.0;
    float h_1 = 0.0;
    int near_1 = 0;
    int far_1 = 0;
    vec4 root_1 = vec4(0.0);
    vec4 square_2 = vec4(0.0);
    x_19 = (min(max(azimuth_2, 0.0), 1.0) * float((columns_1 - 1)));
    float _e24 = x_19;
    column_1 = min(int(_e24), (columns_1 - 2));
    float _e29 = x_19;
    int _e30 = column_1;
    e_1 = (_e29 - float(_e30));
    y_9 = (row_1 * float((rows_1 - 1)));
    float _e37 = y_9;
    line_1 = min(int(_e37), (rows_1 - 2));
    float _e42 = y_9;
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
    float x_20 = 0.0;
    int column_2 = 0;
    float e_2 = 0.0;
    float y_10 = 0.0;
    int line_2 = 0;
    float f_3 = 0.0;
    float g_2 = 0.0;
    float h_2 = 0.0;
    int near_2 = 0;
    int far_2 = 0;
    vec4 root_2 = vec4(0.0);
    vec4 square_3 = vec4(0.0);
    x_20 = (min(max(azimuth_3, 0.0), 1.0) * float((columns_2 - 1)));
    float _e25 = x_20;
    column_2 = min(int(_e25), (columns_2 - 2));
    float _e30 = x_20;
    int _e31 = column_2;
    e_2 = (_e30 - float(_e31));
    y_10 = (row_2 * float((rows_2 - 1)));
    float _e38 = y_10;
    line_2 = min(int(_e38), (rows_2 - 2));
    float _e43 = y_10;
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
    float x_21 = 0.0;
    int column_3 = 0;
    float e_3 = 0.0;
    float y_11 = 0.0;
    int line_3 = 0;
    float f_4 = 0.0;
    float g_3 = 0.0;
    float h_3 = 0.0;
    int near_3 = 0;
    int far_3 = 0;
    vec4 root_3 = vec4(0.0);
    vec4 square_4 = vec4(0.0);
    x_21 = (min(max(azimuth_4, 0.0), 1.0) * float((columns_3 - 1)));
    float _e25 = x_21;
    column_3 = min(int(_e25), (columns_3 - 2));
    float _e30 = x_21;
    int _e31 = column_3;
    e_3 = (_e30 - float(_e31));
    y_11 = (row_3 * float((rows_3 - 1)));
    float _e38 = y_11;
    line_3 = min(int(_e38), (rows_3 - 2));
    float _e43 = y_11;
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

Several_f32_f32_f32_ moved_on(float x_22, float y_12, float z_2, float dx, float dy, float dz, float cosine_1_, float angle_1, float bottom) {
    float sine_1_2 = 0.0;
    float keep = 0.0;
    float away = 0.0;
    if ((angle_1 == 0.0)) {
        return Several_f32_f32_f32_(x_22, y_12, z_2);
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
    return Several_f32_f32_f32_(((_e33 * x_22) + (_e35 * dx)), ((_e38 * y_12) + (_e40 * dy)), ((_e43 * z_2) + (_e45 * dz)));
}

Several_f32_f32_ latitude_longitude(float x_23, float y_13, float z_3) {
    float _e7 = angle_of(z_3, sqrt(((x_23 * x_23) + (y_13 * y_13))));
    float _e8 = angle_of(y_13, x_23);
    return Several_f32_f32_(_e7, _e8);
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
    float y_14 = 0.0;
    float x_24 = 0.0;
    int top = 0;
    int west = 0;
    float down_1 = 0.0;
    float right_3 = 0.0;
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
            int _e73 = c;
            c = (_e73 + 1);
        }
        loop_init = false;
        int _e44 = c;
        if (((_e44 + 3) < 3)) {
        } else {
            break;
        }
        {
            int _e49 = c;
            reflectance_color[_e49] = 0.0;
            int _e52 = c;
            c = (_e52 + 1);
            int _e56 = c;
            reflectance_color[_e56] = 0.0;
            int _e59 = c;
            c = (_e59 + 1);
            int _e63 = c;
            reflectance_color[_e63] = 0.0;
            int _e66 = c;
            c = (_e66 + 1);
            int _e70 = c;
            reflectance_color[_e70] = 0.0;
        }
    }
    bool loop_init_1 = true;
    while(true) {
        if (!loop_init_1) {
            int _e82 = c;
            c = (_e82 + 1);
        }
        loop_init_1 = false;
        int _e76 = c;
        if ((_e76 < 3)) {
        } else {
            break;
        }
        {
            int _e79 = c;
            reflectance_color[_e79] = 0.0;
        }
    }
    step_1_ = 0;
    bool loop_init_2 = true;
    while(true) {
        if (!loop_init_2) {
            int _e597 = step_1_;
            step_1_ = (_e597 + 1);
        }
        loop_init_2 = false;
        int _e86 = step_1_;
        if ((_e86 < 2)) {
        } else {
            break;
        }
        {
            int _e89 = first;
            int _e90 = step_1_;
            int _e93 = size_levels(0);
            which = min((_e89 + _e90), (_e93 - 1));
            float _e97 = level_1;
            int _e98 = first;
            float _e103 = level_1;
            int _e104 = first;
            int _e107 = step_1_;
            part_2 = ((_e107 == 1) ? (_e103 - float(_e104)) : (1.0 - (_e97 - float(_e98))));
            float _e111 = part_2;
            if ((_e111 <= 0.0)) {
                continue;
            }
            int _e114 = which;
            int _e116 = size_levels(1);
            float _e120 = read_levels(((_e114 * _e116) + 0));
            start = int(_e120);
            int _e122 = which;
            int _e124 = size_levels(1);
            float _e128 = read_levels(((_e122 * _e124) + 1));
            height_5 = int(_e128);
            int _e130 = which;
            int _e132 = size_levels(1);
            float _e136 = read_levels(((_e130 * _e132) + 2));
            width_5 = int(_e136);
            int _e142 = height_5;
            int _e149 = height_5;
            y_14 = min(max((((0.5 - (latitude / 3.1415927)) * float(_e142)) - 0.5), 0.0), (float(_e149) - 1.0));
            int _e158 = width_5;
            x_24 = (((0.5 + (longitude / 6.2831855)) * float(_e158)) - 0.5);
            float _e163 = y_14;
            int _e165 = height_5;
            top = min(int(_e163), max((_e165 - 2), 0));
            float _e171 = x_24;
            west = int(floor(_e171));
            float _e174 = y_14;
            int _e175 = top;
            float now_2_5 = (_e174 - float(_e175));
            float _e178 = x_24;
            int _e179 = west;
            float now_3_1 = (_e178 - float(_e179));
            down_1 = now_2_5;
            right_3 = now_3_1;
            int _e182 = top;
            int _e185 = height_5;
            bottom_2 = min((_e182 + 1), (_e185 - 1));
            int _e189 = west;
            int _e192 = width_5;
            int _e193 = whole_rest((_e189 + 1), _e192);
            east = _e193;
            int _e194 = west;
            int _e195 = width_5;
            int _e197 = width_5;
            int _e198 = whole_rest((_e194 + _e195), _e197);
            west = _e198;
            c = 0;
            bool loop_init_3 = true;
            while(true) {
                if (!loop_init_3) {
                    int _e514 = c;
                    c = (_e514 + 1);
                }
                loop_init_3 = false;
                int _e201 = c;
                if (((_e201 + 3) < 3)) {
                } else {
                    break;
                }
                {
                    int _e205 = start;
                    int _e206 = width_5;
                    int _e209 = top;
                    int _e212 = c;
                    upper_row = ((_e205 + ((3 * _e206) * _e209)) + _e212);
                    int _e214 = start;
                    int _e215 = width_5;
                    int _e218 = bottom_2;
                    int _e221 = c;
                    lower_row = ((_e214 + ((3 * _e215) * _e218)) + _e221);
                    int _e223 = upper_row;
                    int _e224 = west;
                    float _e228 = read_texels((_e223 + (3 * _e224)));
                    float _e229 = right_3;
                    int _e233 = upper_row;
                    int _e234 = east;
                    float _e238 = read_texels((_e233 + (3 * _e234)));
                    float _e239 = right_3;
                    upper = ((_e228 * (1.0 - _e229)) + (_e238 * _e239));
                    int _e242 = lower_row;
                    int _e243 = west;
                    float _e247 = read_texels((_e242 + (3 * _e243)));
                    float _e248 = right_3;
                    int _e252 = lower_row;
                    int _e253 = east;
                    float _e257 = read_texels((_e252 + (3 * _e253)));
                    float _e258 = right_3;
                    lower = ((_e247 * (1.0 - _e248)) + (_e257 * _e258));
                    int _e262 = c;
                    int _e265 = c;
                    float _e267 = reflectance_color[_e265];
                    float _e268 = part_2;
                    float _e269 = upper;
                    float _e270 = down_1;
                    float _e274 = lower;
                    float _e275 = down_1;
                    reflectance_color[_e262] = (_e267 + (_e268 * ((_e269 * (1.0 - _e270)) + (_e274 * _e275))));
                    int _e280 = c;
                    c = (_e280 + 1);
                    int _e283 = start;
                    int _e284 = width_5;
                    int _e287 = top;
                    int _e290 = c;
                    upper_row = ((_e283 + ((3 * _e284) * _e287)) + _e290);
                    int _e292 = start;
                    int _e293 = width_5;
                    int _e296 = bottom_2;
                    int _e299 = c;
                    lower_row = ((_e292 + ((3 * _e293) * _e296)) + _e299);
                    int _e301 = upper_row;
                    int _e302 = west;
                    float _e306 = read_texels((_e301 + (3 * _e302)));
                    float _e307 = right_3;
                    int _e311 = upper_row;
                    int _e312 = east;
                    float _e316 = read_texels((_e311 + (3 * _e312)));
                    float _e317 = right_3;
                    upper = ((_e306 * (1.0 - _e307)) + (_e316 * _e317));
                    int _e320 = lower_row;
                    int _e321 = west;
                    float _e325 = read_texels((_e320 + (3 * _e321)));
                    float _e326 = right_3;
                    int _e330 = lower_row;
                    int _e331 = east;
                    float _e335 = read_texels((_e330 + (3 * _e331)));
                    float _e336 = right_3;
                    lower = ((_e325 * (1.0 - _e326)) + (_e335 * _e336));
                    int _e340 = c;
                    int _e343 = c;
                    float _e345 = reflectance_color[_e343];
                    float _e346 = part_2;
                    float _e347 = upper;
                    float _e348 = down_1;
                    float _e352 = lower;
                    float _e353 = down_1;
                    reflectance_color[_e340] = (_e345 + (_e346 * ((_e347 * (1.0 - _e348)) + (_e352 * _e353))));
                    int _e358 = c;
                    c = (_e358 + 1);
                    int _e361 = start;
                    int _e362 = width_5;
                    int _e365 = top;
                    int _e368 = c;
                    upper_row = ((_e361 + ((3 * _e362) * _e365)) + _e368);
                    int _e370 = start;
                    int _e371 = width_5;
                    int _e374 = bottom_2;
                    int _e377 = c;
                    lower_row = ((_e370 + ((3 * _e371) * _e374)) + _e377);
                    int _e379 = upper_row;
                    int _e380 = west;
                    float _e384 = read_texels((_e379 + (3 * _e380)));
                    float _e385 = right_3;
                    int _e389 = upper_row;
                    int _e390 = east;
                    float _e394 = read_texels((_e389 + (3 * _e390)));
                    float _e395 = right_3;
                    upper = ((_e384 * (1.0 - _e385)) + (_e394 * _e395));
                    int _e398 = lower_row;
                    int _e399 = west;
                    float _e403 = read_texels((_e398 + (3 * _e399)));
                    float _e404 = right_3;
                    int _e408 = lower_row;
                    int _e409 = east;
                    float _e413 = read_texels((_e408 + (3 * _e409)));
                    float _e414 = right_3;
                    lower = ((_e403 * (1.0 - _e404)) + (_e413 * _e414));
                    int _e418 = c;
                    int _e421 = c;
                    float _e423 = reflectance_color[_e421];
                    float _e424 = part_2;
                    float _e425 = upper;
                    float _e426 = down_1;
                    float _e430 = lower;
                    float _e431 = down_1;
                    reflectance_color[_e418] = (_e423 + (_e424 * ((_e425 * (1.0 - _e426)) + (_e430 * _e431))));
                    int _e436 = c;
                    c = (_e436 + 1);
                    int _e439 = start;
                    int _e440 = width_5;
                    int _e443 = top;
                    int _e446 = c;
                    upper_row = ((_e439 + ((3 * _e440) * _e443)) + _e446);
                    int _e448 = start;
                    int _e449 = width_5;
                    int _e452 = bottom_2;
                    int _e455 = c;
                    lower_row = ((_e448 + ((3 * _e449) * _e452)) + _e455);
                    int _e457 = upper_row;
                    int _e458 = west;
                    float _e462 = read_texels((_e457 + (3 * _e458)));
                    float _e463 = right_3;
                    int _e467 = upper_row;
                    int _e468 = east;
                    float _e472 = read_texels((_e467 + (3 * _e468)));
                    float _e473 = right_3;
                    upper = ((_e462 * (1.0 - _e463)) + (_e472 * _e473));
                    int _e476 = lower_row;
                    int _e477 = west;
                    float _e481 = read_texels((_e476 + (3 * _e477)));
                    float _e482 = right_3;
                    int _e486 = lower_row;
                    int _e487 = east;
                    float _e491 = read_texels((_e486 + (3 * _e487)));
                    float _e492 = right_3;
                    lower = ((_e481 * (1.0 - _e482)) + (_e491 * _e492));
                    int _e496 = c;
                    int _e499 = c;
                    float _e501 = reflectance_color[_e499];
                    float _e502 = part_2;
                    float _e503 = upper;
                    float _e504 = down_1;
                    float _e508 = lower;
                    float _e509 = down_1;
                    reflectance_color[_e496] = (_e501 + (_e502 * ((_e503 * (1.0 - _e504)) + (_e508 * _e509))));
                }
            }
            bool loop_init_4 = true;
            while(true) {
                if (!loop_init_4) {
                    int _e594 = c;
                    c = (_e594 + 1);
                }
                loop_init_4 = false;
                int _e517 = c;
                if ((_e517 < 3)) {
                } else {
                    break;
                }
                {
                    int _e519 = start;
                    int _e520 = width_5;
                    int _e523 = top;
                    int _e526 = c;
                    upper_row = ((_e519 + ((3 * _e520) * _e523)) + _e526);
                    int _e528 = start;
                    int _e529 = width_5;
                    int _e532 = bottom_2;
                    int _e535 = c;
                    lower_row = ((_e528 + ((3 * _e529) * _e532)) + _e535);
                    int _e537 = upper_row;
                    int _e538 = west;
                    float _e542 = read_texels((_e537 + (3 * _e538)));
                    float _e543 = right_3;
                    int _e547 = upper_row;
                    int _e548 = east;
                    float _e552 = read_texels((_e547 + (3 * _e548)));
                    float _e553 = right_3;
                    upper = ((_e542 * (1.0 - _e543)) + (_e552 * _e553));
                    int _e556 = lower_row;
                    int _e557 = west;
                    float _e561 = read_texels((_e556 + (3 * _e557)));
                    float _e562 = right_3;
                    int _e566 = lower_row;
                    int _e567 = east;
                    float _e571 = read_texels((_e566 + (3 * _e567)));
                    float _e572 = right_3;
                    lower = ((_e561 * (1.0 - _e562)) + (_e571 * _e572));
                    int _e576 = c;
                    int _e579 = c;
                    float _e581 = reflectance_color[_e579];
                    float _e582 = part_2;
                    float _e583 = upper;
                    float _e584 = down_1;
                    float _e588 = lower;
                    float _e589 = down_1;
                    reflectance_color[_e576] = (_e581 + (_e582 * ((_e583 * (1.0 - _e584)) + (_e588 * _e589))));
                }
            }
        }
    }
    return;
}

vec4 reflectance(float x_25, float y_15, float z_4, float sine_1_3, float impact_2, float cosine_1_2, float angle_2) {
    float across_4 = 0.0;
    float up_3 = 0.0;
    float scale_1 = 0.0;
    float px_1 = 0.0;
    float py_1 = 0.0;
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
    float now_2_6 = (_e35 * x_25);
    float _e37 = scale_1;
    float now_3_2 = (_e37 * y_15);
    float now_4_ = up_3;
    px_1 = now_2_6;
    py_1 = now_3_2;
    pz = now_4_;
    float _e40 = px_1;
    float _e41 = py_1;
    float _e42 = pz;
    float _e46 = _group_0_binding_0_fs.shell.x;
    Several_f32_f32_f32_ _e47 = moved_on(_e40, _e41, _e42, x_25, y_15, z_4, cosine_1_2, angle_2, _e46);
    px_1 = _e47.v0_;
    py_1 = _e47.v1_;
    pz = _e47.v2_;
    float _e54 = _group_0_binding_0_fs.planet_x.x;
    float _e55 = px_1;
    float _e60 = _group_0_binding_0_fs.planet_x.y;
    float _e61 = py_1;
    float _e67 = _group_0_binding_0_fs.planet_x.z;
    float _e68 = pz;
    float _e74 = _group_0_binding_0_fs.planet_y.x;
    float _e75 = px_1;
    float _e80 = _group_0_binding_0_fs.planet_y.y;
    float _e81 = py_1;
    float _e87 = _group_0_binding_0_fs.planet_y.z;
    float _e88 = pz;
    float _e94 = _group_0_binding_0_fs.planet_z.x;
    float _e95 = px_1;
    float _e100 = _group_0_binding_0_fs.planet_z.y;
    float _e101 = py_1;
    float _e107 = _group_0_binding_0_fs.planet_z.z;
    float _e108 = pz;
    Several_f32_f32_ _e111 = latitude_longitude((((_e54 * _e55) + (_e60 * _e61)) + (_e67 * _e68)), (((_e74 * _e75) + (_e80 * _e81)) + (_e87 * _e88)), (((_e94 * _e95) + (_e100 * _e101)) + (_e107 * _e108)));
    latitude_1 = _e111.v0_;
    longitude_1 = _e111.v1_;
    float _e114 = px_1;
    float _e115 = px_1;
    float _e117 = py_1;
    float _e118 = py_1;
    float _e121 = pz;
    float _e125 = _group_0_binding_0_fs.observer.x;
    float _e127 = pz;
    float _e131 = _group_0_binding_0_fs.observer.x;
    reach_1 = sqrt((((_e114 * _e115) + (_e117 * _e118)) + ((_e121 - _e125) * (_e127 - _e131))));
    float _e139 = _group_0_binding_0_fs.camera_right.w;
    float _e140 = reach_1;
    float _e144 = _group_0_binding_0_fs.shell.x;
    int _e146 = size_levels(1);
    float _e151 = read_levels(((0 * _e146) + 1));
    float _e152 = map_level(_e139, _e140, cosine_1_2, _e144, _e151);
    level_2 = _e152;
    float _e153 = latitude_1;
    float _e154 = longitude_1;
    float _e155 = level_2;
    map_color_1_(_e153, _e154, _e155);
    total = vec4(0.0);
    c_1 = 0;
    bool loop_init_5 = true;
    while(true) {
        if (!loop_init_5) {
            int _e217 = c_1;
            c_1 = (_e217 + 1);
        }
        loop_init_5 = false;
        int _e160 = c_1;
        if (((_e160 + 3) < 3)) {
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
            int _e175 = c_1;
            c_1 = (_e175 + 1);
            vec4 _e178 = total;
            int _e179 = c_1;
            vec4 _e182 = read_basis((1 * _e179));
            int _e184 = c_1;
            float _e186 = reflectance_color[_e184];
            total = (_e178 + (_e182 * _e186));
            int _e189 = c_1;
            c_1 = (_e189 + 1);
            vec4 _e192 = total;
            int _e193 = c_1;
            vec4 _e196 = read_basis((1 * _e193));
            int _e198 = c_1;
            float _e200 = reflectance_color[_e198];
            total = (_e192 + (_e196 * _e200));
            int _e203 = c_1;
            c_1 = (_e203 + 1);
            vec4 _e206 = total;
            int _e207 = c_1;
            vec4 _e210 = read_basis((1 * _e207));
            int _e212 = c_1;
            float _e214 = reflectance_color[_e212];
            total = (_e206 + (_e210 * _e214));
        }
    }
    bool loop_init_6 = true;
    while(true) {
        if (!loop_init_6) {
            int _e233 = c_1;
            c_1 = (_e233 + 1);
        }
        loop_init_6 = false;
        int _e220 = c_1;
        if ((_e220 < 3)) {
        } else {
            break;
        }
        {
            vec4 _e222 = total;
            int _e223 = c_1;
            vec4 _e226 = read_basis((1 * _e223));
            int _e228 = c_1;
            float _e230 = reflectance_color[_e228];
            total = (_e222 + (_e226 * _e230));
        }
    }
    vec4 _e236 = total;
    return min(max(_e236, vec4(0.0)), vec4(1.0));
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

float bend_angle(float x_26, float mu_4, float bend, float column_4) {
    return (((bend * column_4) * x_26) * sqrt(max(((1.0 - mu_4) * (1.0 + mu_4)), 0.0)));
}

float covered(float apart, float radius_2, float pixel) {
    float rim = 0.0;
    float wide = 0.0;
    float share = 0.0;
    rim = ((pixel * pixel) / 12.0);
    float _e10 = rim;
    wide = max(sqrt(max(((radius_2 * radius_2) - _e10), 0.0)), (0.75 * pixel));
    float _e19 = wide;
    float _e20 = wide;
    float _e22 = rim;
    share = ((radius_2 * radius_2) / ((_e19 * _e20) + _e22));
    float _e25 = share;
    float _e26 = wide;
    return (_e25 * min(max((((_e26 - apart) / pixel) + 0.5), 0.0), 1.0));
}

float shared_out(float across_5, float down_2, float radius_3, float right_x, float below_x, float below_y) {
    float total_1 = 0.0;
    int ring = 0;
    float reach_2 = 0.0;
    int spoke = 0;
    float turn = 0.0;
    float b_2 = 0.0;
    float a_2 = 0.0;
    total_1 = 0.0;
    ring = 0;
    bool loop_init_7 = true;
    while(true) {
        if (!loop_init_7) {
            int _e69 = ring;
            ring = (_e69 + 1);
        }
        loop_init_7 = false;
        int _e15 = ring;
        if ((_e15 < 3)) {
        } else {
            break;
        }
        {
            int _e18 = ring;
            reach_2 = (radius_3 * sqrt(((float(_e18) + 0.5) / 3.0)));
            spoke = 0;
            bool loop_init_8 = true;
            while(true) {
                if (!loop_init_8) {
                    int _e66 = spoke;
                    spoke = (_e66 + 1);
                }
                loop_init_8 = false;
                int _e27 = spoke;
                if ((_e27 < 8)) {
                } else {
                    break;
                }
                {
                    int _e30 = spoke;
                    turn = ((float(_e30) + 0.5) * 0.7853982);
                    float _e36 = reach_2;
                    float _e37 = turn;
                    float _e38 = sine(_e37);
                    b_2 = ((down_2 + (_e36 * _e38)) / below_y);
                    float _e42 = reach_2;
                    float _e43 = turn;
                    float _e44 = cosine(_e43);
                    float _e47 = b_2;
                    a_2 = (((across_5 + (_e42 * _e44)) - (_e47 * below_x)) / right_x);
                    float _e51 = total_1;
                    float _e52 = a_2;
                    float _e58 = b_2;
                    total_1 = (_e51 + (max((1.0 - abs(_e52)), 0.0) * max((1.0 - abs(_e58)), 0.0)));
                }
            }
        }
    }
    float _e72 = total_1;
    return (_e72 / 24.0);
}

void columns_to_top_1_(float r_4, float mu_5, float bottom_3, float top_1) {
    float x_27 = 0.0;
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
    x_27 = (_e17 * float((_e19 - 1)));
    float _e24 = x_27;
    int _e27 = size_columns(0);
    row_4 = min(int(_e24), (_e27 - 2));
    float _e31 = x_27;
    int _e32 = row_4;
    f_5 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_4, mu_5, bottom_3, top_1);
    int _e37 = size_columns(1);
    x_27 = (_e35 * float((_e37 - 1)));
    float _e42 = x_27;
    int _e45 = size_columns(1);
    place = min(int(_e42), (_e45 - 2));
    float _e49 = x_27;
    int _e50 = place;
    e_4 = (_e49 - float(_e50));
    float _e53 = f_5;
    float _e56 = e_4;
    float now_1_4 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_5;
    float _e63 = e_4;
    float now_2_7 = ((1.0 - _e60) * _e63);
    w00_ = now_1_4;
    w01_ = now_2_7;
    float _e65 = f_5;
    float _e66 = e_4;
    float now_3_3 = (_e65 * (1.0 - _e66));
    float _e70 = f_5;
    float _e71 = e_4;
    float now_4_1 = (_e70 * _e71);
    w10_ = now_3_3;
    w11_ = now_4_1;
    float _e73 = distance_to_top(r_4, mu_5, top_1);
    distance_1_2 = _e73;
    int _e75 = size_columns(2);
    c_2 = 0;
    bool loop_init_9 = true;
    while(true) {
        if (!loop_init_9) {
            int _e818 = c_2;
            c_2 = (_e818 + 1);
        }
        loop_init_9 = false;
        int _e77 = c_2;
        if (((_e77 + 3) < _e75)) {
        } else {
            break;
        }
        {
            float _e81 = w00_;
            int _e82 = row_4;
            int _e84 = size_columns(1);
            int _e86 = place;
            int _e89 = size_columns(2);
            int _e91 = c_2;
            int _e94 = size_columns(3);
            float _e98 = read_columns(((((((_e82 * _e84) + _e86) * _e89) + _e91) * _e94) + 0));
            float _e100 = w01_;
            int _e101 = row_4;
            int _e103 = size_columns(1);
            int _e105 = place;
            int _e110 = size_columns(2);
            int _e112 = c_2;
            int _e115 = size_columns(3);
            float _e119 = read_columns(((((((_e101 * _e103) + (_e105 + 1)) * _e110) + _e112) * _e115) + 0));
            float _e122 = w10_;
            int _e123 = row_4;
            int _e127 = size_columns(1);
            int _e129 = place;
            int _e132 = size_columns(2);
            int _e134 = c_2;
            int _e137 = size_columns(3);
            float _e141 = read_columns((((((((_e123 + 1) * _e127) + _e129) * _e132) + _e134) * _e137) + 0));
            float _e144 = w11_;
            int _e145 = row_4;
            int _e149 = size_columns(1);
            int _e151 = place;
            int _e156 = size_columns(2);
            int _e158 = c_2;
            int _e161 = size_columns(3);
            float _e165 = read_columns((((((((_e145 + 1) * _e149) + (_e151 + 1)) * _e156) + _e158) * _e161) + 0));
            scale_2 = ((((_e81 * _e98) + (_e100 * _e119)) + (_e122 * _e141)) + (_e144 * _e165));
            float _e168 = w00_;
            int _e169 = row_4;
            int _e171 = size_columns(1);
            int _e173 = place;
            int _e176 = size_columns(2);
            int _e178 = c_2;
            int _e181 = size_columns(3);
            float _e185 = read_columns(((((((_e169 * _e171) + _e173) * _e176) + _e178) * _e181) + 1));
            float _e187 = w01_;
            int _e188 = row_4;
            int _e190 = size_columns(1);
            int _e192 = place;
            int _e197 = size_columns(2);
            int _e199 = c_2;
            int _e202 = size_columns(3);
            float _e206 = read_columns(((((((_e188 * _e190) + (_e192 + 1)) * _e197) + _e199) * _e202) + 1));
            float _e209 = w10_;
            int _e210 = row_4;
            int _e214 = size_columns(1);
            int _e216 = place;
            int _e219 = size_columns(2);
            int _e221 = c_2;
            int _e224 = size_columns(3);
            float _e228 = read_columns((((((((_e210 + 1) * _e214) + _e216) * _e219) + _e221) * _e224) + 1));
            float _e231 = w11_;
            int _e232 = row_4;
            int _e236 = size_columns(1);
            int _e238 = place;
            int _e243 = size_columns(2);
            int _e245 = c_2;
            int _e248 = size_columns(3);
            float _e252 = read_columns((((((((_e232 + 1) * _e236) + (_e238 + 1)) * _e243) + _e245) * _e248) + 1));
            scaled = ((((_e168 * _e185) + (_e187 * _e206)) + (_e209 * _e228)) + (_e231 * _e252));
            int _e256 = c_2;
            float _e258 = distance_1_2;
            float _e259 = scaled;
            float _e261 = scale_2;
            point_like_columns[_e256] = ((_e258 * _e259) / _e261);
            int _e263 = c_2;
            c_2 = (_e263 + 1);
            float _e266 = w00_;
            int _e267 = row_4;
            int _e269 = size_columns(1);
            int _e271 = place;
            int _e274 = size_columns(2);
            int _e276 = c_2;
            int _e279 = size_columns(3);
            float _e283 = read_columns(((((((_e267 * _e269) + _e271) * _e274) + _e276) * _e279) + 0));
            float _e285 = w01_;
            int _e286 = row_4;
            int _e288 = size_columns(1);
            int _e290 = place;
            int _e295 = size_columns(2);
            int _e297 = c_2;
            int _e300 = size_columns(3);
            float _e304 = read_columns(((((((_e286 * _e288) + (_e290 + 1)) * _e295) + _e297) * _e300) + 0));
            float _e307 = w10_;
            int _e308 = row_4;
            int _e312 = size_columns(1);
            int _e314 = place;
            int _e317 = size_columns(2);
            int _e319 = c_2;
            int _e322 = size_columns(3);
            float _e326 = read_columns((((((((_e308 + 1) * _e312) + _e314) * _e317) + _e319) * _e322) + 0));
            float _e329 = w11_;
            int _e330 = row_4;
            int _e334 = size_columns(1);
            int _e336 = place;
            int _e341 = size_columns(2);
            int _e343 = c_2;
            int _e346 = size_columns(3);
            float _e350 = read_columns((((((((_e330 + 1) * _e334) + (_e336 + 1)) * _e341) + _e343) * _e346) + 0));
            scale_2 = ((((_e266 * _e283) + (_e285 * _e304)) + (_e307 * _e326)) + (_e329 * _e350));
            float _e353 = w00_;
            int _e354 = row_4;
            int _e356 = size_columns(1);
            int _e358 = place;
            int _e361 = size_columns(2);
            int _e363 = c_2;
            int _e366 = size_columns(3);
            float _e370 = read_columns(((((((_e354 * _e356) + _e358) * _e361) + _e363) * _e366) + 1));
            float _e372 = w01_;
            int _e373 = row_4;
            int _e375 = size_columns(1);
            int _e377 = place;
            int _e382 = size_columns(2);
            int _e384 = c_2;
            int _e387 = size_columns(3);
            float _e391 = read_columns(((((((_e373 * _e375) + (_e377 + 1)) * _e382) + _e384) * _e387) + 1));
            float _e394 = w10_;
            int _e395 = row_4;
            int _e399 = size_columns(1);
            int _e401 = place;
            int _e404 = size_columns(2);
            int _e406 = c_2;
            int _e409 = size_columns(3);
            float _e413 = read_columns((((((((_e395 + 1) * _e399) + _e401) * _e404) + _e406) * _e409) + 1));
            float _e416 = w11_;
            int _e417 = row_4;
            int _e421 = size_columns(1);
            int _e423 = place;
            int _e428 = size_columns(2);
            int _e430 = c_2;
            int _e433 = size_columns(3);
            float _e437 = read_columns((((((((_e417 + 1) * _e421) + (_e423 + 1)) * _e428) + _e430) * _e433) + 1));
            scaled = ((((_e353 * _e370) + (_e372 * _e391)) + (_e394 * _e413)) + (_e416 * _e437));
            int _e441 = c_2;
            float _e443 = distance_1_2;
            float _e444 = scaled;
            float _e446 = scale_2;
            point_like_columns[_e441] = ((_e443 * _e444) / _e446);
            int _e448 = c_2;
            c_2 = (_e448 + 1);
            float _e451 = w00_;
            int _e452 = row_4;
            int _e454 = size_columns(1);
            int _e456 = place;
            int _e459 = size_columns(2);
            int _e461 = c_2;
            int _e464 = size_columns(3);
            float _e468 = read_columns(((((((_e452 * _e454) + _e456) * _e459) + _e461) * _e464) + 0));
            float _e470 = w01_;
            int _e471 = row_4;
            int _e473 = size_columns(1);
            int _e475 = place;
            int _e480 = size_columns(2);
            int _e482 = c_2;
            int _e485 = size_columns(3);
            float _e489 = read_columns(((((((_e471 * _e473) + (_e475 + 1)) * _e480) + _e482) * _e485) + 0));
            float _e492 = w10_;
            int _e493 = row_4;
            int _e497 = size_columns(1);
            int _e499 = place;
            int _e502 = size_columns(2);
            int _e504 = c_2;
            int _e507 = size_columns(3);
            float _e511 = read_columns((((((((_e493 + 1) * _e497) + _e499) * _e502) + _e504) * _e507) + 0));
            float _e514 = w11_;
            int _e515 = row_4;
            int _e519 = size_columns(1);
            int _e521 = place;
            int _e526 = size_columns(2);
            int _e528 = c_2;
            int _e531 = size_columns(3);
            float _e535 = read_columns((((((((_e515 + 1) * _e519) + (_e521 + 1)) * _e526) + _e528) * _e531) + 0));
            scale_2 = ((((_e451 * _e468) + (_e470 * _e489)) + (_e492 * _e511)) + (_e514 * _e535));
            float _e538 = w00_;
            int _e539 = row_4;
            int _e541 = size_columns(1);
            int _e543 = place;
            int _e546 = size_columns(2);
            int _e548 = c_2;
            int _e551 = size_columns(3);
            float _e555 = read_columns(((((((_e539 * _e541) + _e543) * _e546) + _e548) * _e551) + 1));
            float _e557 = w01_;
            int _e558 = row_4;
            int _e560 = size_columns(1);
            int _e562 = place;
            int _e567 = size_columns(2);
            int _e569 = c_2;
            int _e572 = size_columns(3);
            float _e576 = read_columns(((((((_e558 * _e560) + (_e562 + 1)) * _e567) + _e569) * _e572) + 1));
            float _e579 = w10_;
            int _e580 = row_4;
            int _e584 = size_columns(1);
            int _e586 = place;
            int _e589 = size_columns(2);
            int _e591 = c_2;
            int _e594 = size_columns(3);
            float _e598 = read_columns((((((((_e580 + 1) * _e584) + _e586) * _e589) + _e591) * _e594) + 1));
            float _e601 = w11_;
            int _e602 = row_4;
            int _e606 = size_columns(1);
            int _e608 = place;
            int _e613 = size_columns(2);
            int _e615 = c_2;
            int _e618 = size_columns(3);
            float _e622 = read_columns((((((((_e602 + 1) * _e606) + (_e608 + 1)) * _e613) + _e615) * _e618) + 1));
            scaled = ((((_e538 * _e555) + (_e557 * _e576)) + (_e579 * _e598)) + (_e601 * _e622));
            int _e626 = c_2;
            float _e628 = distance_1_2;
            float _e629 = scaled;
            float _e631 = scale_2;
            point_like_columns[_e626] = ((_e628 * _e629) / _e631);
            int _e633 = c_2;
            c_2 = (_e633 + 1);
            float _e636 = w00_;
            int _e637 = row_4;
            int _e639 = size_columns(1);
            int _e641 = place;
            int _e644 = size_columns(2);
            int _e646 = c_2;
            int _e649 = size_columns(3);
            float _e653 = read_columns(((((((_e637 * _e639) + _e641) * _e644) + _e646) * _e649) + 0));
            float _e655 = w01_;
            int _e656 = row_4;
            int _e658 = size_columns(1);
            int _e660 = place;
            int _e665 = size_columns(2);
            int _e667 = c_2;
            int _e670 = size_columns(3);
            float _e674 = read_columns(((((((_e656 * _e658) + (_e660 + 1)) * _e665) + _e667) * _e670) + 0));
            float _e677 = w10_;
            int _e678 = row_4;
            int _e682 = size_columns(1);
            int _e684 = place;
            int _e687 = size_columns(2);
            int _e689 = c_2;
            int _e692 = size_columns(3);
            float _e696 = read_columns((((((((_e678 + 1) * _e682) + _e684) * _e687) + _e689) * _e692) + 0));
            float _e699 = w11_;
            int _e700 = row_4;
            int _e704 = size_columns(1);
            int _e706 = place;
            int _e711 = size_columns(2);
            int _e713 = c_2;
            int _e716 = size_columns(3);
            float _e720 = read_columns((((((((_e700 + 1) * _e704) + (_e706 + 1)) * _e711) + _e713) * _e716) + 0));
            scale_2 = ((((_e636 * _e653) + (_e655 * _e674)) + (_e677 * _e696)) + (_e699 * _e720));
            float _e723 = w00_;
            int _e724 = row_4;
            int _e726 = size_columns(1);
            int _e728 = place;
            int _e731 = size_columns(2);
            int _e733 = c_2;
            int _e736 = size_columns(3);
            float _e740 = read_columns(((((((_e724 * _e726) + _e728) * _e731) + _e733) * _e736) + 1));
            float _e742 = w01_;
            int _e743 = row_4;
            int _e745 = size_columns(1);
            int _e747 = place;
            int _e752 = size_columns(2);
            int _e754 = c_2;
            int _e757 = size_columns(3);
            float _e761 = read_columns(((((((_e743 * _e745) + (_e747 + 1)) * _e752) + _e754) * _e757) + 1));
            float _e764 = w10_;
            int _e765 = row_4;
            int _e769 = size_columns(1);
            int _e771 = place;
            int _e774 = size_columns(2);
            int _e776 = c_2;
            int _e779 = size_columns(3);
            float _e783 = read_columns((((((((_e765 + 1) * _e769) + _e771) * _e774) + _e776) * _e779) + 1));
            float _e786 = w11_;
            int _e787 = row_4;
            int _e791 = size_columns(1);
            int _e793 = place;
            int _e798 = size_columns(2);
            int _e800 = c_2;
            int _e803 = size_columns(3);
            float _e807 = read_columns((((((((_e787 + 1) * _e791) + (_e793 + 1)) * _e798) + _e800) * _e803) + 1));
            scaled = ((((_e723 * _e740) + (_e742 * _e761)) + (_e764 * _e783)) + (_e786 * _e807));
            int _e811 = c_2;
            float _e813 = distance_1_2;
            float _e814 = scaled;
            float _e816 = scale_2;
            point_like_columns[_e811] = ((_e813 * _e814) / _e816);
        }
    }
    bool loop_init_10 = true;
    while(true) {
        if (!loop_init_10) {
            int _e1005 = c_2;
            c_2 = (_e1005 + 1);
        }
        loop_init_10 = false;
        int _e821 = c_2;
        if ((_e821 < _e75)) {
        } else {
            break;
        }
        {
            float _e823 = w00_;
            int _e824 = row_4;
            int _e826 = size_columns(1);
            int _e828 = place;
            int _e831 = size_columns(2);
            int _e833 = c_2;
            int _e836 = size_columns(3);
            float _e840 = read_columns(((((((_e824 * _e826) + _e828) * _e831) + _e833) * _e836) + 0));
            float _e842 = w01_;
            int _e843 = row_4;
            int _e845 = size_columns(1);
            int _e847 = place;
            int _e852 = size_columns(2);
            int _e854 = c_2;
            int _e857 = size_columns(3);
            float _e861 = read_columns(((((((_e843 * _e845) + (_e847 + 1)) * _e852) + _e854) * _e857) + 0));
            float _e864 = w10_;
            int _e865 = row_4;
            int _e869 = size_columns(1);
            int _e871 = place;
            int _e874 = size_columns(2);
            int _e876 = c_2;
            int _e879 = size_columns(3);
            float _e883 = read_columns((((((((_e865 + 1) * _e869) + _e871) * _e874) + _e876) * _e879) + 0));
            float _e886 = w11_;
            int _e887 = row_4;
            int _e891 = size_columns(1);
            int _e893 = place;
            int _e898 = size_columns(2);
            int _e900 = c_2;
            int _e903 = size_columns(3);
            float _e907 = read_columns((((((((_e887 + 1) * _e891) + (_e893 + 1)) * _e898) + _e900) * _e903) + 0));
            scale_2 = ((((_e823 * _e840) + (_e842 * _e861)) + (_e864 * _e883)) + (_e886 * _e907));
            float _e910 = w00_;
            int _e911 = row_4;
            int _e913 = size_columns(1);
            int _e915 = place;
            int _e918 = size_columns(2);
            int _e920 = c_2;
            int _e923 = size_columns(3);
            float _e927 = read_columns(((((((_e911 * _e913) + _e915) * _e918) + _e920) * _e923) + 1));
            float _e929 = w01_;
            int _e930 = row_4;
            int _e932 = size_columns(1);
            int _e934 = place;
            int _e939 = size_columns(2);
            int _e941 = c_2;
            int _e944 = size_columns(3);
            float _e948 = read_columns(((((((_e930 * _e932) + (_e934 + 1)) * _e939) + _e941) * _e944) + 1));
            float _e951 = w10_;
            int _e952 = row_4;
            int _e956 = size_columns(1);
            int _e958 = place;
            int _e961 = size_columns(2);
            int _e963 = c_2;
            int _e966 = size_columns(3);
            float _e970 = read_columns((((((((_e952 + 1) * _e956) + _e958) * _e961) + _e963) * _e966) + 1));
            float _e973 = w11_;
            int _e974 = row_4;
            int _e978 = size_columns(1);
            int _e980 = place;
            int _e985 = size_columns(2);
            int _e987 = c_2;
            int _e990 = size_columns(3);
            float _e994 = read_columns((((((((_e974 + 1) * _e978) + (_e980 + 1)) * _e985) + _e987) * _e990) + 1));
            scaled = ((((_e910 * _e927) + (_e929 * _e948)) + (_e951 * _e970)) + (_e973 * _e994));
            int _e998 = c_2;
            float _e1000 = distance_1_2;
            float _e1001 = scaled;
            float _e1003 = scale_2;
            point_like_columns[_e998] = ((_e1000 * _e1001) / _e1003);
        }
    }
    return;
}

Several_f32_f32_f32_bool leaving_air_1_(float x_28, float y_16, float z_5) {
    float level_3 = 0.0;
    float impact_3 = 0.0;
    float start_r = 0.0;
    float start_mu = 0.0;
    bool inside = false;
    bool free = false;
    int c_3 = 0;
    float angle_3 = 0.0;
    float turn_1 = 0.0;
    float keep_1 = 0.0;
    float scale_3 = 0.0;
    bool local_2 = false;
    bool local_3 = false;
    bool local_4 = false;
    level_3 = sqrt(((x_28 * x_28) + (y_16 * y_16)));
    float _e21 = _group_0_binding_0_fs.observer.x;
    float _e22 = level_3;
    impact_3 = (_e21 * _e22);
    float now_1_5 = _group_0_binding_0_fs.observer.x;
    start_r = now_1_5;
    start_mu = z_5;
    inside = true;
    free = true;
    float _e33 = _group_0_binding_0_fs.observer.y;
    if ((_e33 > 0.5)) {
        if ((z_5 < 0.0)) {
            float _e40 = impact_3;
            float _e44 = _group_0_binding_0_fs.shell.y;
            local_2 = (_e40 < _e44);
        } else {
            local_2 = false;
        }
        bool _e47 = local_2;
        inside = _e47;
        bool _e48 = inside;
        if (_e48) {
            float _e51 = impact_3;
            float _e55 = _group_0_binding_0_fs.shell.x;
            local_3 = (_e51 < _e55);
        } else {
            local_3 = false;
        }
        bool _e58 = local_3;
        free = !(_e58);
        float _e63 = _group_0_binding_0_fs.shell.y;
        start_r = _e63;
        float _e67 = _group_0_binding_0_fs.shell.y;
        float _e68 = impact_3;
        float _e73 = _group_0_binding_0_fs.shell.y;
        float _e74 = impact_3;
        float _e84 = _group_0_binding_0_fs.shell.y;
        start_mu = (-(sqrt(max(((_e67 - _e68) * (_e73 + _e74)), 0.0))) / _e84);
    } else {
        float _e86 = level_3;
        float _e90 = _group_0_binding_0_fs.observer.z;
        float _e94 = _group_0_binding_0_fs.observer.w;
        float _e95 = angle_above_horizon(z_5, _e86, _e90, _e94);
        free = (_e95 >= 0.0);
    }
    float _e101 = _group_0_binding_0_fs.counts.x;
    int end_5_ = int(_e101);
    c_3 = 0;
    bool loop_init_11 = true;
    while(true) {
        if (!loop_init_11) {
            int _e133 = c_3;
            c_3 = (_e133 + 1);
        }
        loop_init_11 = false;
        int _e104 = c_3;
        if (((_e104 + 3) < end_5_)) {
        } else {
            break;
        }
        {
            int _e109 = c_3;
            point_like_columns[_e109] = 0.0;
            int _e112 = c_3;
            c_3 = (_e112 + 1);
            int _e116 = c_3;
            point_like_columns[_e116] = 0.0;
            int _e119 = c_3;
            c_3 = (_e119 + 1);
            int _e123 = c_3;
            point_like_columns[_e123] = 0.0;
            int _e126 = c_3;
            c_3 = (_e126 + 1);
            int _e130 = c_3;
            point_like_columns[_e130] = 0.0;
        }
    }
    bool loop_init_12 = true;
    while(true) {
        if (!loop_init_12) {
            int _e142 = c_3;
            c_3 = (_e142 + 1);
        }
        loop_init_12 = false;
        int _e136 = c_3;
        if ((_e136 < end_5_)) {
        } else {
            break;
        }
        {
            int _e139 = c_3;
            point_like_columns[_e139] = 0.0;
        }
    }
    bool _e145 = inside;
    if (_e145) {
        bool _e148 = free;
        local_4 = _e148;
    } else {
        local_4 = false;
    }
    bool _e150 = local_4;
    if (_e150) {
        float _e151 = start_r;
        float _e152 = start_mu;
        float _e156 = _group_0_binding_0_fs.shell.x;
        float _e160 = _group_0_binding_0_fs.shell.y;
        columns_to_top_1_(_e151, _e152, _e156, _e160);
        float _e164 = _group_0_binding_0_fs.shell.w;
        if ((_e164 > 0.0)) {
            float _e167 = start_r;
            float _e168 = start_mu;
            float _e172 = _group_0_binding_0_fs.shell.w;
            float _e177 = _group_0_binding_0_fs.counts.x;
            float _e182 = point_like_columns[(int(_e177) - 1)];
            float _e183 = bend_angle(_e167, _e168, _e172, _e182);
            angle_3 = _e183;
            float _e184 = angle_3;
            float _e185 = sine(_e184);
            float _e186 = angle_3;
            float _e187 = cosine(_e186);
            turn_1 = _e185;
            keep_1 = _e187;
            float _e188 = level_3;
            float _e189 = keep_1;
            float _e191 = turn_1;
            float _e194 = level_3;
            scale_3 = (((_e188 * _e189) + (z_5 * _e191)) / max(_e194, 1e-30));
            float _e198 = scale_3;
            float _e200 = scale_3;
            float _e202 = keep_1;
            float _e204 = level_3;
            float _e205 = turn_1;
            bool _e208 = free;
            return Several_f32_f32_f32_bool((x_28 * _e198), (y_16 * _e200), ((z_5 * _e202) - (_e204 * _e205)), _e208);
        }
    }
    bool _e210 = free;
    return Several_f32_f32_f32_bool(x_28, y_16, z_5, _e210);
}

float point_like(float px_2, float py_2, float otherwise) {
    int place_1 = 0;
    float aside = 0.0;
    float below = 0.0;
    float x_29 = 0.0;
    float y_17 = 0.0;
    float z_6 = 0.0;
    float nx = 0.0;
    float ny = 0.0;
    float nz = 0.0;
    bool free_1 = false;
    bool near_4 = false;
    int u_1 = 0;
    int v = 0;
    float ux = 0.0;
    float uy = 0.0;
    float uz = 0.0;
    float vx = 0.0;
    float vy = 0.0;
    float vz = 0.0;
    float right_4 = 0.0;
    float slant = 0.0;
    float upright = 0.0;
    float dx_1 = 0.0;
    float dy_1 = 0.0;
    float dz_1 = 0.0;
    float across_6 = 0.0;
    float down_3 = 0.0;
    float part_3 = 0.0;
    bool local_5 = false;
    bool local_6 = false;
    place_1 = 0;
    bool loop_init_13 = true;
    while(true) {
        if (!loop_init_13) {
            int _e144 = place_1;
            place_1 = (_e144 + 1);
        }
        loop_init_13 = false;
        int _e32 = place_1;
        if ((_e32 < 5)) {
        } else {
            break;
        }
        {
            int _e35 = place_1;
            int _e41 = place_1;
            aside = ((_e41 == 1) ? 1.0 : ((_e35 == 3) ? -1.0 : 0.0));
            int _e46 = place_1;
            int _e52 = place_1;
            below = ((_e52 == 2) ? 1.0 : ((_e46 == 4) ? -1.0 : 0.0));
            float _e57 = aside;
            float _e59 = below;
            Several_f32_f32_f32_ _e61 = camera_direction((px_2 + _e57), (py_2 + _e59));
            x_29 = _e61.v0_;
            y_17 = _e61.v1_;
            z_6 = _e61.v2_;
            float _e65 = x_29;
            float _e66 = y_17;
            float _e67 = z_6;
            Several_f32_f32_f32_bool _e68 = leaving_air_1_(_e65, _e66, _e67);
            nx = _e68.v0_;
            ny = _e68.v1_;
            nz = _e68.v2_;
            free_1 = _e68.v3_;
            int _e73 = place_1;
            if ((_e73 > 0)) {
                float _e76 = nx;
                float _e79 = point_like_steps[0];
                float now_3_4 = (_e76 - _e79);
                float _e81 = ny;
                float _e84 = point_like_steps[1];
                float now_4_2 = (_e81 - _e84);
                float _e86 = nz;
                float _e89 = point_like_steps[2];
                float now_5_1 = (_e86 - _e89);
                nx = now_3_4;
                ny = now_4_2;
                nz = now_5_1;
            }
            int _e92 = place_1;
            float _e96 = nx;
            point_like_steps[(3 * _e92)] = _e96;
            int _e98 = place_1;
            float _e104 = ny;
            point_like_steps[((3 * _e98) + 1)] = _e104;
            int _e106 = place_1;
            float _e112 = nz;
            point_like_steps[((3 * _e106) + 2)] = _e112;
            float _e113 = nx;
            float _e114 = nx;
            float _e116 = ny;
            float _e117 = ny;
            float _e120 = nz;
            float _e121 = nz;
            float _e127 = _group_0_binding_0_fs.camera_right.w;
            float _e130 = squared((3.0 * _e127));
            near_4 = ((((_e113 * _e114) + (_e116 * _e117)) + (_e120 * _e121)) < _e130);
            int _e133 = place_1;
            bool _e135 = free_1;
            if (_e135) {
                bool _e138 = near_4;
                local_5 = _e138;
            } else {
                local_5 = false;
            }
            bool _e140 = local_5;
            point_like_fits[_e133] = (_e140 ? 1.0 : 0.0);
        }
    }
    float _e149 = point_like_fits[1];
    u_1 = ((_e149 > 0.5) ? 3 : 9);
    float _e157 = point_like_fits[2];
    v = ((_e157 > 0.5) ? 6 : 12);
    int _e164 = u_1;
    int _e166 = whole_quotient(_e164, 3);
    float _e168 = point_like_fits[_e166];
    if (!((_e168 < 0.5))) {
        int _e175 = v;
        int _e177 = whole_quotient(_e175, 3);
        float _e179 = point_like_fits[_e177];
        local_6 = (_e179 < 0.5);
    } else {
        local_6 = true;
    }
    bool _e183 = local_6;
    if (_e183) {
        return otherwise;
    }
    int _e185 = u_1;
    float now_6_1 = point_like_steps[_e185];
    int _e189 = u_1;
    float now_7_1 = point_like_steps[(_e189 + 1)];
    int _e195 = u_1;
    float now_8_ = point_like_steps[(_e195 + 2)];
    ux = now_6_1;
    uy = now_7_1;
    uz = now_8_;
    int _e201 = v;
    float now_9_1 = point_like_steps[_e201];
    int _e205 = v;
    float now_10_1 = point_like_steps[(_e205 + 1)];
    int _e211 = v;
    float now_11_ = point_like_steps[(_e211 + 2)];
    vx = now_9_1;
    vy = now_10_1;
    vz = now_11_;
    float _e216 = ux;
    float _e217 = ux;
    float _e219 = uy;
    float _e220 = uy;
    float _e223 = uz;
    float _e224 = uz;
    right_4 = sqrt((((_e216 * _e217) + (_e219 * _e220)) + (_e223 * _e224)));
    float _e228 = right_4;
    if ((_e228 == 0.0)) {
        return otherwise;
    }
    float _e231 = ux;
    float _e232 = right_4;
    float now_12_1 = (_e231 / _e232);
    float _e234 = uy;
    float _e235 = right_4;
    float now_13_1 = (_e234 / _e235);
    float _e237 = uz;
    float _e238 = right_4;
    float now_14_1 = (_e237 / _e238);
    ux = now_12_1;
    uy = now_13_1;
    uz = now_14_1;
    float _e240 = ux;
    float _e241 = vx;
    float _e243 = uy;
    float _e244 = vy;
    float _e247 = uz;
    float _e248 = vz;
    slant = (((_e240 * _e241) + (_e243 * _e244)) + (_e247 * _e248));
    float _e251 = vx;
    float _e252 = slant;
    float _e253 = ux;
    float now_15_ = (_e251 - (_e252 * _e253));
    float _e256 = vy;
    float _e257 = slant;
    float _e258 = uy;
    float now_16_1 = (_e256 - (_e257 * _e258));
    float _e261 = vz;
    float _e262 = slant;
    float _e263 = uz;
    float now_17_1 = (_e261 - (_e262 * _e263));
    vx = now_15_;
    vy = now_16_1;
    vz = now_17_1;
    float _e266 = vx;
    float _e267 = vx;
    float _e269 = vy;
    float _e270 = vy;
    float _e273 = vz;
    float _e274 = vz;
    upright = sqrt((((_e266 * _e267) + (_e269 * _e270)) + (_e273 * _e274)));
    float _e278 = right_4;
    float _e279 = upright;
    float _e284 = _group_0_binding_0_fs.camera_right.w;
    float _e290 = _group_0_binding_0_fs.camera_right.w;
    if (((_e278 * _e279) < ((0.3 * _e284) * _e290))) {
        return otherwise;
    }
    float _e296 = _group_0_binding_0_fs.star.x;
    float _e299 = point_like_steps[0];
    float now_18_ = (_e296 - _e299);
    float _e303 = point_like_steps[1];
    float now_19_ = -(_e303);
    float _e308 = _group_0_binding_0_fs.star.y;
    float _e311 = point_like_steps[2];
    float now_20_ = (_e308 - _e311);
    dx_1 = now_18_;
    dy_1 = now_19_;
    dz_1 = now_20_;
    float _e313 = dx_1;
    float _e314 = ux;
    float _e316 = dy_1;
    float _e317 = uy;
    float _e320 = dz_1;
    float _e321 = uz;
    across_6 = (((_e313 * _e314) + (_e316 * _e317)) + (_e320 * _e321));
    float _e324 = dx_1;
    float _e325 = vx;
    float _e327 = dy_1;
    float _e328 = vy;
    float _e331 = dz_1;
    float _e332 = vz;
    float _e335 = upright;
    down_3 = ((((_e324 * _e325) + (_e327 * _e328)) + (_e331 * _e332)) / _e335);
    float _e337 = across_6;
    float _e338 = down_3;
    float _e342 = _group_0_binding_0_fs.shell.z;
    float _e343 = right_4;
    float _e344 = slant;
    float _e345 = upright;
    float _e346 = shared_out(_e337, _e338, _e342, _e343, _e344, _e345);
    part_3 = _e346;
    float _e347 = part_3;
    float _e348 = right_4;
    float _e349 = upright;
    return (_e347 / (_e348 * _e349));
}

void columns_to_top_2_(float r_5, float mu_6, float bottom_4, float top_2) {
    float x_30 = 0.0;
    int row_5 = 0;
    float f_6 = 0.0;
    int place_2 = 0;
    float e_5 = 0.0;
    float w00_1 = 0.0;
    float w01_1 = 0.0;
    float w10_1 = 0.0;
    float w11_1 = 0.0;
    float distance_1_3 = 0.0;
    int c_4 = 0;
    float scale_4 = 0.0;
    float scaled_1 = 0.0;
    float _e17 = altitude_coordinate(r_5, bottom_4, top_2);
    int _e19 = size_columns(0);
    x_30 = (_e17 * float((_e19 - 1)));
    float _e24 = x_30;
    int _e27 = size_columns(0);
    row_5 = min(int(_e24), (_e27 - 2));
    float _e31 = x_30;
    int _e32 = row_5;
    f_6 = (_e31 - float(_e32));
    float _e35 = direction_coordinate(r_5, mu_6, bottom_4, top_2);
    int _e37 = size_columns(1);
    x_30 = (_e35 * float((_e37 - 1)));
    float _e42 = x_30;
    int _e45 = size_columns(1);
    place_2 = min(int(_e42), (_e45 - 2));
    float _e49 = x_30;
    int _e50 = place_2;
    e_5 = (_e49 - float(_e50));
    float _e53 = f_6;
    float _e56 = e_5;
    float now_1_6 = ((1.0 - _e53) * (1.0 - _e56));
    float _e60 = f_6;
    float _e63 = e_5;
    float now_2_8 = ((1.0 - _e60) * _e63);
    w00_1 = now_1_6;
    w01_1 = now_2_8;
    float _e65 = f_6;
    float _e66 = e_5;
    float now_3_5 = (_e65 * (1.0 - _e66));
    float _e70 = f_6;
    float _e71 = e_5;
    float now_4_3 = (_e70 * _e71);
    w10_1 = now_3_5;
    w11_1 = now_4_3;
    float _e73 = distance_to_top(r_5, mu_6, top_2);
    distance_1_3 = _e73;
    int _e75 = size_columns(2);
    c_4 = 0;
    bool loop_init_14 = true;
    while(true) {
        if (!loop_init_14) {
            int _e818 = c_4;
            c_4 = (_e818 + 1);
        }
        loop_init_14 = false;
        int _e77 = c_4;
        if (((_e77 + 3) < _e75)) {
        } else {
            break;
        }
        {
            float _e81 = w00_1;
            int _e82 = row_5;
            int _e84 = size_columns(1);
            int _e86 = place_2;
            int _e89 = size_columns(2);
            int _e91 = c_4;
            int _e94 = size_columns(3);
            float _e98 = read_columns(((((((_e82 * _e84) + _e86) * _e89) + _e91) * _e94) + 0));
            float _e100 = w01_1;
            int _e101 = row_5;
            int _e103 = size_columns(1);
            int _e105 = place_2;
            int _e110 = size_columns(2);
            int _e112 = c_4;
            int _e115 = size_columns(3);
            float _e119 = read_columns(((((((_e101 * _e103) + (_e105 + 1)) * _e110) + _e112) * _e115) + 0));
            float _e122 = w10_1;
            int _e123 = row_5;
            int _e127 = size_columns(1);
            int _e129 = place_2;
            int _e132 = size_columns(2);
            int _e134 = c_4;
            int _e137 = size_columns(3);
            float _e141 = read_columns((((((((_e123 + 1) * _e127) + _e129) * _e132) + _e134) * _e137) + 0));
            float _e144 = w11_1;
            int _e145 = row_5;
            int _e149 = size_columns(1);
            int _e151 = place_2;
            int _e156 = size_columns(2);
            int _e158 = c_4;
            int _e161 = size_columns(3);
            float _e165 = read_columns((((((((_e145 + 1) * _e149) + (_e151 + 1)) * _e156) + _e158) * _e161) + 0));
            scale_4 = ((((_e81 * _e98) + (_e100 * _e119)) + (_e122 * _e141)) + (_e144 * _e165));
            float _e168 = w00_1;
            int _e169 = row_5;
            int _e171 = size_columns(1);
            int _e173 = place_2;
            int _e176 = size_columns(2);
            int _e178 = c_4;
            int _e181 = size_columns(3);
            float _e185 = read_columns(((((((_e169 * _e171) + _e173) * _e176) + _e178) * _e181) + 1));
            float _e187 = w01_1;
            int _e188 = row_5;
            int _e190 = size_columns(1);
            int _e192 = place_2;
            int _e197 = size_columns(2);
            int _e199 = c_4;
            int _e202 = size_columns(3);
            float _e206 = read_columns(((((((_e188 * _e190) + (_e192 + 1)) * _e197) + _e199) * _e202) + 1));
            float _e209 = w10_1;
            int _e210 = row_5;
            int _e214 = size_columns(1);
            int _e216 = place_2;
            int _e219 = size_columns(2);
            int _e221 = c_4;
            int _e224 = size_columns(3);
            float _e228 = read_columns((((((((_e210 + 1) * _e214) + _e216) * _e219) + _e221) * _e224) + 1));
            float _e231 = w11_1;
            int _e232 = row_5;
            int _e236 = size_columns(1);
            int _e238 = place_2;
            int _e243 = size_columns(2);
            int _e245 = c_4;
            int _e248 = size_columns(3);
            float _e252 = read_columns((((((((_e232 + 1) * _e236) + (_e238 + 1)) * _e243) + _e245) * _e248) + 1));
            scaled_1 = ((((_e168 * _e185) + (_e187 * _e206)) + (_e209 * _e228)) + (_e231 * _e252));
            int _e256 = c_4;
            float _e258 = distance_1_3;
            float _e259 = scaled_1;
            float _e261 = scale_4;
            star_disc_columns[_e256] = ((_e258 * _e259) / _e261);
            int _e263 = c_4;
            c_4 = (_e263 + 1);
            float _e266 = w00_1;
            int _e267 = row_5;
            int _e269 = size_columns(1);
            int _e271 = place_2;
            int _e274 = size_columns(2);
            int _e276 = c_4;
            int _e279 = size_columns(3);
            float _e283 = read_columns(((((((_e267 * _e269) + _e271) * _e274) + _e276) * _e279) + 0));
            float _e285 = w01_1;
            int _e286 = row_5;
            int _e288 = size_columns(1);
            int _e290 = place_2;
            int _e295 = size_columns(2);
            int _e297 = c_4;
            int _e300 = size_columns(3);
            float _e304 = read_columns(((((((_e286 * _e288) + (_e290 + 1)) * _e295) + _e297) * _e300) + 0));
            float _e307 = w10_1;
            int _e308 = row_5;
            int _e312 = size_columns(1);
            int _e314 = place_2;
            int _e317 = size_columns(2);
            int _e319 = c_4;
            int _e322 = size_columns(3);
            float _e326 = read_columns((((((((_e308 + 1) * _e312) + _e314) * _e317) + _e319) * _e322) + 0));
            float _e329 = w11_1;
            int _e330 = row_5;
            int _e334 = size_columns(1);
            int _e336 = place_2;
            int _e341 = size_columns(2);
            int _e343 = c_4;
            int _e346 = size_columns(3);
            float _e350 = read_columns((((((((_e330 + 1) * _e334) + (_e336 + 1)) * _e341) + _e343) * _e346) + 0));
            scale_4 = ((((_e266 * _e283) + (_e285 * _e304)) + (_e307 * _e326)) + (_e329 * _e350));
            float _e353 = w00_1;
            int _e354 = row_5;
            int _e356 = size_columns(1);
            int _e358 = place_2;
            int _e361 = size_columns(2);
            int _e363 = c_4;
            int _e366 = size_columns(3);
            float _e370 = read_columns(((((((_e354 * _e356) + _e358) * _e361) + _e363) * _e366) + 1));
            float _e372 = w01_1;
            int _e373 = row_5;
            int _e375 = size_columns(1);
            int _e377 = place_2;
            int _e382 = size_columns(2);
            int _e384 = c_4;
            int _e387 = size_columns(3);
            float _e391 = read_columns(((((((_e373 * _e375) + (_e377 + 1)) * _e382) + _e384) * _e387) + 1));
            float _e394 = w10_1;
            int _e395 = row_5;
            int _e399 = size_columns(1);
            int _e401 = place_2;
            int _e404 = size_columns(2);
            int _e406 = c_4;
            int _e409 = size_columns(3);
            float _e413 = read_columns((((((((_e395 + 1) * _e399) + _e401) * _e404) + _e406) * _e409) + 1));
            float _e416 = w11_1;
            int _e417 = row_5;
            int _e421 = size_columns(1);
            int _e423 = place_2;
            int _e428 = size_columns(2);
            int _e430 = c_4;
            int _e433 = size_columns(3);
            float _e437 = read_columns((((((((_e417 + 1) * _e421) + (_e423 + 1)) * _e428) + _e430) * _e433) + 1));
            scaled_1 = ((((_e353 * _e370) + (_e372 * _e391)) + (_e394 * _e413)) + (_e416 * _e437));
            int _e441 = c_4;
            float _e443 = distance_1_3;
            float _e444 = scaled_1;
            float _e446 = scale_4;
            star_disc_columns[_e441] = ((_e443 * _e444) / _e446);
            int _e448 = c_4;
            c_4 = (_e448 + 1);
            float _e451 = w00_1;
            int _e452 = row_5;
            int _e454 = size_columns(1);
            int _e456 = place_2;
            int _e459 = size_columns(2);
            int _e461 = c_4;
            int _e464 = size_columns(3);
            float _e468 = read_columns(((((((_e452 * _e454) + _e456) * _e459) + _e461) * _e464) + 0));
            float _e470 = w01_1;
            int _e471 = row_5;
            int _e473 = size_columns(1);
            int _e475 = place_2;
            int _e480 = size_columns(2);
            int _e482 = c_4;
            int _e485 = size_columns(3);
            float _e489 = read_columns(((((((_e471 * _e473) + (_e475 + 1)) * _e480) + _e482) * _e485) + 0));
            float _e492 = w10_1;
            int _e493 = row_5;
            int _e497 = size_columns(1);
            int _e499 = place_2;
            int _e502 = size_columns(2);
            int _e504 = c_4;
            int _e507 = size_columns(3);
            float _e511 = read_columns((((((((_e493 + 1) * _e497) + _e499) * _e502) + _e504) * _e507) + 0));
            float _e514 = w11_1;
            int _e515 = row_5;
            int _e519 = size_columns(1);
            int _e521 = place_2;
            int _e526 = size_columns(2);
            int _e528 = c_4;
            int _e531 = size_columns(3);
            float _e535 = read_columns((((((((_e515 + 1) * _e519) + (_e521 + 1)) * _e526) + _e528) * _e531) + 0));
            scale_4 = ((((_e451 * _e468) + (_e470 * _e489)) + (_e492 * _e511)) + (_e514 * _e535));
            float _e538 = w00_1;
            int _e539 = row_5;
            int _e541 = size_columns(1);
            int _e543 = place_2;
            int _e546 = size_columns(2);
            int _e548 = c_4;
            int _e551 = size_columns(3);
            float _e555 = read_columns(((((((_e539 * _e541) + _e543) * _e546) + _e548) * _e551) + 1));
            float _e557 = w01_1;
            int _e558 = row_5;
            int _e560 = size_columns(1);
            int _e562 = place_2;
            int _e567 = size_columns(2);
            int _e569 = c_4;
            int _e572 = size_columns(3);
            float _e576 = read_columns(((((((_e558 * _e560) + (_e562 + 1)) * _e567) + _e569) * _e572) + 1));
            float _e579 = w10_1;
            int _e580 = row_5;
            int _e584 = size_columns(1);
            int _e586 = place_2;
            int _e589 = size_columns(2);
            int _e591 = c_4;
            int _e594 = size_columns(3);
            float _e598 = read_columns((((((((_e580 + 1) * _e584) + _e586) * _e589) + _e591) * _e594) + 1));
            float _e601 = w11_1;
            int _e602 = row_5;
            int _e606 = size_columns(1);
            int _e608 = place_2;
            int _e613 = size_columns(2);
            int _e615 = c_4;
            int _e618 = size_columns(3);
            float _e622 = read_columns((((((((_e602 + 1) * _e606) + (_e608 + 1)) * _e613) + _e615) * _e618) + 1));
            scaled_1 = ((((_e538 * _e555) + (_e557 * _e576)) + (_e579 * _e598)) + (_e601 * _e622));
            int _e626 = c_4;
            float _e628 = distance_1_3;
            float _e629 = scaled_1;
            float _e631 = scale_4;
            star_disc_columns[_e626] = ((_e628 * _e629) / _e631);
            int _e633 = c_4;
            c_4 = (_e633 + 1);
            float _e636 = w00_1;
            int _e637 = row_5;
            int _e639 = size_columns(1);
            int _e641 = place_2;
            int _e644 = size_columns(2);
            int _e646 = c_4;
            int _e649 = size_columns(3);
            float _e653 = read_columns(((((((_e637 * _e639) + _e641) * _e644) + _e646) * _e649) + 0));
            float _e655 = w01_1;
            int _e656 = row_5;
            int _e658 = size_columns(1);
            int _e660 = place_2;
            int _e665 = size_columns(2);
            int _e667 = c_4;
            int _e670 = size_columns(3);
            float _e674 = read_columns(((((((_e656 * _e658) + (_e660 + 1)) * _e665) + _e667) * _e670) + 0));
            float _e677 = w10_1;
            int _e678 = row_5;
            int _e682 = size_columns(1);
            int _e684 = place_2;
            int _e687 = size_columns(2);
            int _e689 = c_4;
            int _e692 = size_columns(3);
            float _e696 = read_columns((((((((_e678 + 1) * _e682) + _e684) * _e687) + _e689) * _e692) + 0));
            float _e699 = w11_1;
            int _e700 = row_5;
            int _e704 = size_columns(1);
            int _e706 = place_2;
            int _e711 = size_columns(2);
            int _e713 = c_4;
            int _e716 = size_columns(3);
            float _e720 = read_columns((((((((_e700 + 1) * _e704) + (_e706 + 1)) * _e711) + _e713) * _e716) + 0));
            scale_4 = ((((_e636 * _e653) + (_e655 * _e674)) + (_e677 * _e696)) + (_e699 * _e720));
            float _e723 = w00_1;
            int _e724 = row_5;
            int _e726 = size_columns(1);
            int _e728 = place_2;
            int _e731 = size_columns(2);
            int _e733 = c_4;
            int _e736 = size_columns(3);
            float _e740 = read_columns(((((((_e724 * _e726) + _e728) * _e731) + _e733) * _e736) + 1));
            float _e742 = w01_1;
            int _e743 = row_5;
            int _e745 = size_columns(1);
            int _e747 = place_2;
            int _e752 = size_columns(2);
            int _e754 = c_4;
            int _e757 = size_columns(3);
            float _e761 = read_columns(((((((_e743 * _e745) + (_e747 + 1)) * _e752) + _e754) * _e757) + 1));
            float _e764 = w10_1;
            int _e765 = row_5;
            int _e769 = size_columns(1);
            int _e771 = place_2;
            int _e774 = size_columns(2);
            int _e776 = c_4;
            int _e779 = size_columns(3);
            float _e783 = read_columns((((((((_e765 + 1) * _e769) + _e771) * _e774) + _e776) * _e779) + 1));
            float _e786 = w11_1;
            int _e787 = row_5;
            int _e791 = size_columns(1);
            int _e793 = place_2;
            int _e798 = size_columns(2);
            int _e800 = c_4;
            int _e803 = size_columns(3);
            float _e807 = read_columns((((((((_e787 + 1) * _e791) + (_e793 + 1)) * _e798) + _e800) * _e803) + 1));
            scaled_1 = ((((_e723 * _e740) + (_e742 * _e761)) + (_e764 * _e783)) + (_e786 * _e807));
            int _e811 = c_4;
            float _e813 = distance_1_3;
            float _e814 = scaled_1;
            float _e816 = scale_4;
            star_disc_columns[_e811] = ((_e813 * _e814) / _e816);
        }
    }
    bool loop_init_15 = true;
    while(true) {
        if (!loop_init_15) {
            int _e1005 = c_4;
            c_4 = (_e1005 + 1);
        }
        loop_init_15 = false;
        int _e821 = c_4;
        if ((_e821 < _e75)) {
        } else {
            break;
        }
        {
            float _e823 = w00_1;
            int _e824 = row_5;
            int _e826 = size_columns(1);
            int _e828 = place_2;
            int _e831 = size_columns(2);
            int _e833 = c_4;
            int _e836 = size_columns(3);
            float _e840 = read_columns(((((((_e824 * _e826) + _e828) * _e831) + _e833) * _e836) + 0));
            float _e842 = w01_1;
            int _e843 = row_5;
            int _e845 = size_columns(1);
            int _e847 = place_2;
            int _e852 = size_columns(2);
            int _e854 = c_4;
            int _e857 = size_columns(3);
            float _e861 = read_columns(((((((_e843 * _e845) + (_e847 + 1)) * _e852) + _e854) * _e857) + 0));
            float _e864 = w10_1;
            int _e865 = row_5;
            int _e869 = size_columns(1);
            int _e871 = place_2;
            int _e874 = size_columns(2);
            int _e876 = c_4;
            int _e879 = size_columns(3);
            float _e883 = read_columns((((((((_e865 + 1) * _e869) + _e871) * _e874) + _e876) * _e879) + 0));
            float _e886 = w11_1;
            int _e887 = row_5;
            int _e891 = size_columns(1);
            int _e893 = place_2;
            int _e898 = size_columns(2);
            int _e900 = c_4;
            int _e903 = size_columns(3);
            float _e907 = read_columns((((((((_e887 + 1) * _e891) + (_e893 + 1)) * _e898) + _e900) * _e903) + 0));
            scale_4 = ((((_e823 * _e840) + (_e842 * _e861)) + (_e864 * _e883)) + (_e886 * _e907));
            float _e910 = w00_1;
            int _e911 = row_5;
            int _e913 = size_columns(1);
            int _e915 = place_2;
            int _e918 = size_columns(2);
            int _e920 = c_4;
            int _e923 = size_columns(3);
            float _e927 = read_columns(((((((_e911 * _e913) + _e915) * _e918) + _e920) * _e923) + 1));
            float _e929 = w01_1;
            int _e930 = row_5;
            int _e932 = size_columns(1);
            int _e934 = place_2;
            int _e939 = size_columns(2);
            int _e941 = c_4;
            int _e944 = size_columns(3);
            float _e948 = read_columns(((((((_e930 * _e932) + (_e934 + 1)) * _e939) + _e941) * _e944) + 1));
            float _e951 = w10_1;
            int _e952 = row_5;
            int _e956 = size_columns(1);
            int _e958 = place_2;
            int _e961 = size_columns(2);
            int _e963 = c_4;
            int _e966 = size_columns(3);
            float _e970 = read_columns((((((((_e952 + 1) * _e956) + _e958) * _e961) + _e963) * _e966) + 1));
            float _e973 = w11_1;
            int _e974 = row_5;
            int _e978 = size_columns(1);
            int _e980 = place_2;
            int _e985 = size_columns(2);
            int _e987 = c_4;
            int _e990 = size_columns(3);
            float _e994 = read_columns((((((((_e974 + 1) * _e978) + (_e980 + 1)) * _e985) + _e987) * _e990) + 1));
            scaled_1 = ((((_e910 * _e927) + (_e929 * _e948)) + (_e951 * _e970)) + (_e973 * _e994));
            int _e998 = c_4;
            float _e1000 = distance_1_3;
            float _e1001 = scaled_1;
            float _e1003 = scale_4;
            star_disc_columns[_e998] = ((_e1000 * _e1001) / _e1003);
        }
    }
    return;
}

Several_f32_f32_f32_bool leaving_air_2_(float x_31, float y_18, float z_7) {
    float level_4 = 0.0;
    float impact_4 = 0.0;
    float start_r_1 = 0.0;
    float start_mu_1 = 0.0;
    bool inside_1 = false;
    bool free_2 = false;
    int c_5 = 0;
    float angle_4 = 0.0;
    float turn_2 = 0.0;
    float keep_2 = 0.0;
    float scale_5 = 0.0;
    bool local_7 = false;
    bool local_8 = false;
    bool local_9 = false;
    level_4 = sqrt(((x_31 * x_31) + (y_18 * y_18)));
    float _e21 = _group_0_binding_0_fs.observer.x;
    float _e22 = level_4;
    impact_4 = (_e21 * _e22);
    float now_1_7 = _group_0_binding_0_fs.observer.x;
    start_r_1 = now_1_7;
    start_mu_1 = z_7;
    inside_1 = true;
    free_2 = true;
    float _e33 = _group_0_binding_0_fs.observer.y;
    if ((_e33 > 0.5)) {
        if ((z_7 < 0.0)) {
            float _e40 = impact_4;
            float _e44 = _group_0_binding_0_fs.shell.y;
            local_7 = (_e40 < _e44);
        } else {
            local_7 = false;
        }
        bool _e47 = local_7;
        inside_1 = _e47;
        bool _e48 = inside_1;
        if (_e48) {
            float _e51 = impact_4;
            float _e55 = _group_0_binding_0_fs.shell.x;
            local_8 = (_e51 < _e55);
        } else {
            local_8 = false;
        }
        bool _e58 = local_8;
        free_2 = !(_e58);
        float _e63 = _group_0_binding_0_fs.shell.y;
        start_r_1 = _e63;
        float _e67 = _group_0_binding_0_fs.shell.y;
        float _e68 = impact_4;
        float _e73 = _group_0_binding_0_fs.shell.y;
        float _e74 = impact_4;
        float _e84 = _group_0_binding_0_fs.shell.y;
        start_mu_1 = (-(sqrt(max(((_e67 - _e68) * (_e73 + _e74)), 0.0))) / _e84);
    } else {
        float _e86 = level_4;
        float _e90 = _group_0_binding_0_fs.observer.z;
        float _e94 = _group_0_binding_0_fs.observer.w;
        float _e95 = angle_above_horizon(z_7, _e86, _e90, _e94);
        free_2 = (_e95 >= 0.0);
    }
    float _e101 = _group_0_binding_0_fs.counts.x;
    int end_5_1 = int(_e101);
    c_5 = 0;
    bool loop_init_16 = true;
    while(true) {
        if (!loop_init_16) {
            int _e133 = c_5;
            c_5 = (_e133 + 1);
        }
        loop_init_16 = false;
        int _e104 = c_5;
        if (((_e104 + 3) < end_5_1)) {
        } else {
            break;
        }
        {
            int _e109 = c_5;
            star_disc_columns[_e109] = 0.0;
            int _e112 = c_5;
            c_5 = (_e112 + 1);
            int _e116 = c_5;
            star_disc_columns[_e116] = 0.0;
            int _e119 = c_5;
            c_5 = (_e119 + 1);
            int _e123 = c_5;
            star_disc_columns[_e123] = 0.0;
            int _e126 = c_5;
            c_5 = (_e126 + 1);
            int _e130 = c_5;
            star_disc_columns[_e130] = 0.0;
        }
    }
    bool loop_init_17 = true;
    while(true) {
        if (!loop_init_17) {
            int _e142 = c_5;
            c_5 = (_e142 + 1);
        }
        loop_init_17 = false;
        int _e136 = c_5;
        if ((_e136 < end_5_1)) {
        } else {
            break;
        }
        {
            int _e139 = c_5;
            star_disc_columns[_e139] = 0.0;
        }
    }
    bool _e145 = inside_1;
    if (_e145) {
        bool _e148 = free_2;
        local_9 = _e148;
    } else {
        local_9 = false;
    }
    bool _e150 = local_9;
    if (_e150) {
        float _e151 = start_r_1;
        float _e152 = start_mu_1;
        float _e156 = _group_0_binding_0_fs.shell.x;
        float _e160 = _group_0_binding_0_fs.shell.y;
        columns_to_top_2_(_e151, _e152, _e156, _e160);
        float _e164 = _group_0_binding_0_fs.shell.w;
        if ((_e164 > 0.0)) {
            float _e167 = start_r_1;
            float _e168 = start_mu_1;
            float _e172 = _group_0_binding_0_fs.shell.w;
            float _e177 = _group_0_binding_0_fs.counts.x;
            float _e182 = star_disc_columns[(int(_e177) - 1)];
            float _e183 = bend_angle(_e167, _e168, _e172, _e182);
            angle_4 = _e183;
            float _e184 = angle_4;
            float _e185 = sine(_e184);
            float _e186 = angle_4;
            float _e187 = cosine(_e186);
            turn_2 = _e185;
            keep_2 = _e187;
            float _e188 = level_4;
            float _e189 = keep_2;
            float _e191 = turn_2;
            float _e194 = level_4;
            scale_5 = (((_e188 * _e189) + (z_7 * _e191)) / max(_e194, 1e-30));
            float _e198 = scale_5;
            float _e200 = scale_5;
            float _e202 = keep_2;
            float _e204 = level_4;
            float _e205 = turn_2;
            bool _e208 = free_2;
            return Several_f32_f32_f32_bool((x_31 * _e198), (y_18 * _e200), ((z_7 * _e202) - (_e204 * _e205)), _e208);
        }
    }
    bool _e210 = free_2;
    return Several_f32_f32_f32_bool(x_31, y_18, z_7, _e210);
}

vec4 through_columns_1_(int constituents) {
    vec4 tau = vec4(0.0);
    int c_6 = 0;
    tau = vec4(0.0);
    c_6 = 0;
    bool loop_init_18 = true;
    while(true) {
        if (!loop_init_18) {
            int _e71 = c_6;
            c_6 = (_e71 + 1);
        }
        loop_init_18 = false;
        int _e6 = c_6;
        if (((_e6 + 3) < constituents)) {
        } else {
            break;
        }
        {
            vec4 _e10 = tau;
            int _e11 = c_6;
            vec4 _e16 = read_extinction(((1 * _e11) + 0));
            int _e18 = c_6;
            float _e20 = star_disc_columns[_e18];
            tau = (_e10 + (_e16 * _e20));
            int _e23 = c_6;
            c_6 = (_e23 + 1);
            vec4 _e26 = tau;
            int _e27 = c_6;
            vec4 _e32 = read_extinction(((1 * _e27) + 0));
            int _e34 = c_6;
            float _e36 = star_disc_columns[_e34];
            tau = (_e26 + (_e32 * _e36));
            int _e39 = c_6;
            c_6 = (_e39 + 1);
            vec4 _e42 = tau;
            int _e43 = c_6;
            vec4 _e48 = read_extinction(((1 * _e43) + 0));
            int _e50 = c_6;
            float _e52 = star_disc_columns[_e50];
            tau = (_e42 + (_e48 * _e52));
            int _e55 = c_6;
            c_6 = (_e55 + 1);
            vec4 _e58 = tau;
            int _e59 = c_6;
            vec4 _e64 = read_extinction(((1 * _e59) + 0));
            int _e66 = c_6;
            float _e68 = star_disc_columns[_e66];
            tau = (_e58 + (_e64 * _e68));
        }
    }
    bool loop_init_19 = true;
    while(true) {
        if (!loop_init_19) {
            int _e89 = c_6;
            c_6 = (_e89 + 1);
        }
        loop_init_19 = false;
        int _e74 = c_6;
        if ((_e74 < constituents)) {
        } else {
            break;
        }
        {
            vec4 _e76 = tau;
            int _e77 = c_6;
            vec4 _e82 = read_extinction(((1 * _e77) + 0));
            int _e84 = c_6;
            float _e86 = star_disc_columns[_e84];
            tau = (_e76 + (_e82 * _e86));
        }
    }
    vec4 _e92 = tau;
    return exp((vec4(0.0) - _e92));
}

vec4 star_disc(float px_3, float py_3) {
    float x_32 = 0.0;
    float y_19 = 0.0;
    float z_8 = 0.0;
    float lx = 0.0;
    float ly = 0.0;
    float lz = 0.0;
    bool free_3 = false;
    float apart_1 = 0.0;
    float pixel_1 = 0.0;
    float part_4 = 0.0;
    vec4 through = vec4(0.0);
    bool local_10 = false;
    Several_f32_f32_f32_ _e13 = camera_direction(px_3, py_3);
    x_32 = _e13.v0_;
    y_19 = _e13.v1_;
    z_8 = _e13.v2_;
    float _e17 = x_32;
    float _e18 = y_19;
    float _e19 = z_8;
    Several_f32_f32_f32_bool _e20 = leaving_air_2_(_e17, _e18, _e19);
    lx = _e20.v0_;
    ly = _e20.v1_;
    lz = _e20.v2_;
    free_3 = _e20.v3_;
    float _e25 = lx;
    float _e26 = ly;
    float _e27 = lz;
    float _e31 = _group_0_binding_0_fs.star.x;
    float _e35 = _group_0_binding_0_fs.star.y;
    float _e36 = half_sine_between(_e25, _e26, _e27, _e31, _e35);
    apart_1 = (2.0 * _e36);
    float _e42 = _group_0_binding_0_fs.camera_right.w;
    pixel_1 = _e42;
    bool _e43 = free_3;
    if (!(!(_e43))) {
        float _e48 = apart_1;
        float _e52 = _group_0_binding_0_fs.shell.z;
        float _e53 = pixel_1;
        local_10 = (_e48 > (_e52 + (3.0 * _e53)));
    } else {
        local_10 = true;
    }
    bool _e59 = local_10;
    if (_e59) {
        return vec4(0.0);
    }
    float _e62 = apart_1;
    float _e66 = _group_0_binding_0_fs.shell.z;
    float _e67 = pixel_1;
    float _e68 = covered(_e62, _e66, _e67);
    float _e72 = _group_0_binding_0_fs.camera_up.w;
    part_4 = (_e68 * _e72);
    float _e77 = _group_0_binding_0_fs.shell.z;
    float _e78 = pixel_1;
    if ((_e77 < (1.5 * _e78))) {
        float _e82 = part_4;
        float _e83 = point_like(px_3, py_3, _e82);
        part_4 = _e83;
    }
    float _e87 = _group_0_binding_0_fs.counts.x;
    vec4 _e89 = through_columns_1_(int(_e87));
    through = _e89;
    vec4 _e90 = through;
    float _e91 = part_4;
    return (_e90 * _e91);
}

float physical_light(float light) {
    return min(((light > 0.0) ? light : 0.0), 1e18);
}

float exponential_curve(float x_33) {
    return (1.0 - exp(-(x_33)));
}

float exponential_shown(float light_1) {
    float _e1 = physical_light(light_1);
    float _e2 = exponential_curve(_e1);
    return _e2;
}

float hable_curve(float light_2) {
    float x_34 = 0.0;
    float curve = 0.0;
    x_34 = (2.0 * light_2);
    float _e5 = x_34;
    float _e6 = x_34;
    x_34 = ((_e6 < 11.2) ? _e5 : 11.2);
    float _e11 = x_34;
    float _e12 = x_34;
    float _e20 = x_34;
    float _e21 = x_34;
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
    float r_6 = 0.0;
    float g_4 = 0.0;
    float b_3 = 0.0;
    float darkening = 0.0;
    float _e7 = physical_light(red_1);
    float _e8 = physical_light(green_1);
    float _e9 = physical_light(blue_1);
    r_6 = _e7;
    g_4 = _e8;
    b_3 = _e9;
    float _e10 = r_6;
    float _e11 = g_4;
    float _e12 = b_3;
    float _e13 = luminance_of(_e10, _e11, _e12);
    darkening = (1.0 / (1.0 + _e13));
    float _e18 = r_6;
    float _e19 = darkening;
    float _e21 = g_4;
    float _e22 = darkening;
    float _e24 = b_3;
    float _e25 = darkening;
    return Several_f32_f32_f32_((_e18 * _e19), (_e21 * _e22), (_e24 * _e25));
}

Several_f32_f32_f32_ reinhard_extended_color(float red_2, float green_2, float blue_2, float white) {
    float r_7 = 0.0;
    float g_5 = 0.0;
    float b_4 = 0.0;
    float bright = 0.0;
    float darkening_1 = 0.0;
    float _e9 = physical_light(red_2);
    float _e10 = physical_light(green_2);
    float _e11 = physical_light(blue_2);
    r_7 = _e9;
    g_5 = _e10;
    b_4 = _e11;
    float _e12 = r_7;
    float _e13 = g_5;
    float _e14 = b_4;
    float _e15 = luminance_of(_e12, _e13, _e14);
    bright = _e15;
    float _e16 = bright;
    float _e21 = bright;
    darkening_1 = ((1.0 + (_e16 / (white * white))) / (1.0 + _e21));
    float _e25 = r_7;
    float _e26 = darkening_1;
    float _e28 = g_5;
    float _e29 = darkening_1;
    float _e31 = b_4;
    float _e32 = darkening_1;
    return Several_f32_f32_f32_((_e25 * _e26), (_e28 * _e29), (_e31 * _e32));
}

float aces_curve(float x_35) {
    return (((x_35 * (x_35 + 0.0245786)) - 9.0537e-5) / ((x_35 * ((0.983729 * x_35) + 0.432951)) + 0.238081));
}

Several_f32_f32_f32_ aces_color(float red_3, float green_3, float blue_3) {
    float r_8 = 0.0;
    float g_6 = 0.0;
    float b_5 = 0.0;
    float x_36 = 0.0;
    float y_20 = 0.0;
    float z_9 = 0.0;
    float _e9 = physical_light(red_3);
    float _e10 = physical_light(green_3);
    float _e11 = physical_light(blue_3);
    r_8 = _e9;
    g_6 = _e10;
    b_5 = _e11;
    float _e12 = r_8;
    float _e15 = g_6;
    float _e19 = b_5;
    float _e23 = aces_curve((((0.59719 * _e12) + (0.35458 * _e15)) + (0.04823 * _e19)));
    x_36 = _e23;
    float _e24 = r_8;
    float _e27 = g_6;
    float _e31 = b_5;
    float _e35 = aces_curve((((0.076 * _e24) + (0.90834 * _e27)) + (0.01566 * _e31)));
    y_20 = _e35;
    float _e36 = r_8;
    float _e39 = g_6;
    float _e43 = b_5;
    float _e47 = aces_curve((((0.0284 * _e36) + (0.13383 * _e39)) + (0.83777 * _e43)));
    z_9 = _e47;
    float _e48 = x_36;
    float _e51 = y_20;
    float _e55 = z_9;
    float _e63 = x_36;
    float _e66 = y_20;
    float _e70 = z_9;
    float _e78 = x_36;
    float _e81 = y_20;
    float _e85 = z_9;
    return Several_f32_f32_f32_(min(max((((1.60475 * _e48) + (-0.53108 * _e51)) + (-0.07367 * _e55)), 0.0), 1.0), min(max((((-0.10208 * _e63) + (1.10813 * _e66)) + (-0.00605 * _e70)), 0.0), 1.0), min(max((((-0.00327 * _e78) + (-0.07276 * _e81)) + (1.07602 * _e85)), 0.0), 1.0));
}

float agx_curve(float light_4) {
    float least = 0.0;
    float x_37 = 0.0;
    float t = 0.0;
    float y_21 = 0.0;
    least = 0.00017578126;
    float _e6 = least;
    float _e7 = least;
    x_37 = (((log2((((light_4 > _e7) ? light_4 : _e6) / 0.18)) - -10.0) / 16.5) - 0.6060606);
    float _e19 = x_37;
    float _e20 = x_37;
    x_37 = ((_e20 < 0.3939394) ? _e19 : 0.3939394);
    float _e25 = x_37;
    if ((_e25 < 0.0)) {
        float _e28 = x_37;
        t = ((-2.0 * _e28) / 0.51227736);
        float _e33 = t;
        float _e36 = t;
        float _e37 = cubed(_e36);
        y_21 = (0.5 - ((0.51227736 * _e33) / pow((1.0 + _e37), 0.33333334)));
    } else {
        float _e45 = x_37;
        t = ((2.0 * _e45) / 0.54146415);
        float _e50 = t;
        float _e53 = t;
        y_21 = (0.5 + ((0.54146415 * _e50) / pow((1.0 + pow(_e53, 3.25)), 0.30769232)));
    }
    float _e63 = y_21;
    float _e64 = y_21;
    return ((_e64 > 0.0) ? _e63 : 0.0);
}

Several_f32_f32_f32_ agx_color(float red_4, float green_4, float blue_4) {
    float r_9 = 0.0;
    float g_7 = 0.0;
    float b_6 = 0.0;
    float x_38 = 0.0;
    float y_22 = 0.0;
    float z_10 = 0.0;
    float _e9 = physical_light(red_4);
    float _e10 = physical_light(green_4);
    float _e11 = physical_light(blue_4);
    r_9 = _e9;
    g_7 = _e10;
    b_6 = _e11;
    float _e12 = r_9;
    float _e15 = g_7;
    float _e19 = b_6;
    float _e23 = agx_curve((((0.84247905 * _e12) + (0.0784336 * _e15)) + (0.079223745 * _e19)));
    x_38 = _e23;
    float _e24 = r_9;
    float _e27 = g_7;
    float _e31 = b_6;
    float _e35 = agx_curve((((0.042328242 * _e24) + (0.87846863 * _e27)) + (0.07916613 * _e31)));
    y_22 = _e35;
    float _e36 = r_9;
    float _e39 = g_7;
    float _e43 = b_6;
    float _e47 = agx_curve((((0.042375654 * _e36) + (0.0784336 * _e39)) + (0.879143 * _e43)));
    z_10 = _e47;
    float _e48 = x_38;
    float _e51 = y_22;
    float _e55 = z_10;
    float _e65 = x_38;
    float _e68 = y_22;
    float _e72 = z_10;
    float _e82 = x_38;
    float _e85 = y_22;
    float _e89 = z_10;
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

Several_f32_f32_f32_ displayed(float red_given, float green_given, float blue_given) {
    float red_6 = 0.0;
    float green_6 = 0.0;
    float blue_6 = 0.0;
    red_6 = red_given;
    green_6 = green_given;
    blue_6 = blue_given;
    float _e9 = _group_0_binding_0_fs.display.y;
    float _e11 = red_6;
    float _e15 = _group_0_binding_0_fs.display.x;
    float _e17 = green_6;
    float _e21 = _group_0_binding_0_fs.display.x;
    float _e23 = blue_6;
    float _e27 = _group_0_binding_0_fs.display.x;
    Several_f32_f32_f32_ _e29 = tone_mapped(int(_e9), (_e11 * _e15), (_e17 * _e21), (_e23 * _e27));
    red_6 = _e29.v0_;
    green_6 = _e29.v1_;
    blue_6 = _e29.v2_;
    float _e36 = _group_0_binding_0_fs.display.z;
    if ((int(_e36) < 0)) {
        float _e40 = red_6;
        float _e41 = green_6;
        float _e42 = blue_6;
        return Several_f32_f32_f32_(_e40, _e41, _e42);
    }
    float _e47 = _group_0_binding_0_fs.display.z;
    float _e49 = red_6;
    float _e50 = encoded(int(_e47), _e49);
    float _e54 = _group_0_binding_0_fs.display.z;
    float _e56 = green_6;
    float _e57 = encoded(int(_e54), _e56);
    float _e61 = _group_0_binding_0_fs.display.z;
    float _e63 = blue_6;
    float _e64 = encoded(int(_e61), _e63);
    return Several_f32_f32_f32_(_e50, _e57, _e64);
}

void light_of_pixel_1_(float px_4, float py_4) {
    float x_39 = 0.0;
    float y_23 = 0.0;
    float z_11 = 0.0;
    vec4 total_2 = vec4(0.0);
    float sine_1_4 = 0.0;
    float impact_5 = 0.0;
    float angle_up = 0.0;
    bool to_ground = false;
    bool inside_2 = false;
    float row_6 = 0.0;
    bool shown = false;
    float cos_azimuth = 0.0;
    float half_sine_1 = 0.0;
    vec4 ground = vec4(0.0);
    float bent = 0.0;
    int columns_4 = 0;
    int rows_5 = 0;
    float azimuth_5 = 0.0;
    vec4 albedo = vec4(0.0);
    float cosine_1_3 = 0.0;
    bool local_11 = false;
    bool local_12 = false;
    bool local_13 = false;
    bool local_14 = false;
    bool local_15 = false;
    bool local_16 = false;
    bool local_17 = false;
    Several_f32_f32_f32_ _e22 = camera_direction(px_4, py_4);
    x_39 = _e22.v0_;
    y_23 = _e22.v1_;
    z_11 = _e22.v2_;
    total_2 = vec4(0.0);
    float _e28 = x_39;
    float _e29 = x_39;
    float _e31 = y_23;
    float _e32 = y_23;
    sine_1_4 = sqrt(((_e28 * _e29) + (_e31 * _e32)));
    float _e39 = _group_0_binding_0_fs.observer.x;
    float _e40 = sine_1_4;
    impact_5 = (_e39 * _e40);
    float _e42 = z_11;
    float _e43 = sine_1_4;
    float _e47 = _group_0_binding_0_fs.observer.z;
    float _e51 = _group_0_binding_0_fs.observer.w;
    float _e52 = angle_above_horizon(_e42, _e43, _e47, _e51);
    angle_up = _e52;
    float _e53 = angle_up;
    to_ground = (_e53 < 0.0);
    inside_2 = true;
    float _e57 = angle_up;
    float _e61 = _group_0_binding_0_fs.observer.z;
    float _e62 = row_from_angle(_e57, _e61);
    row_6 = _e62;
    float _e66 = _group_0_binding_0_fs.observer.y;
    if ((_e66 > 0.5)) {
        float _e69 = z_11;
        if ((_e69 < 0.0)) {
            float _e74 = impact_5;
            float _e78 = _group_0_binding_0_fs.shell.y;
            local_11 = (_e74 < _e78);
        } else {
            local_11 = false;
        }
        bool _e81 = local_11;
        inside_2 = _e81;
        bool _e82 = inside_2;
        if (_e82) {
            float _e85 = impact_5;
            float _e89 = _group_0_binding_0_fs.shell.x;
            local_12 = (_e85 < _e89);
        } else {
            local_12 = false;
        }
        bool _e92 = local_12;
        to_ground = _e92;
        float _e93 = impact_5;
        float _e97 = _group_0_binding_0_fs.shell.x;
        float _e101 = _group_0_binding_0_fs.shell.y;
        float _e102 = row_from_impact(_e93, _e97, _e101);
        row_6 = _e102;
    }
    float _e103 = x_39;
    if (!((_e103 != 0.0))) {
        float _e109 = y_23;
        local_13 = (_e109 != 0.0);
    } else {
        local_13 = true;
    }
    bool _e113 = local_13;
    if (!(_e113)) {
        float _e117 = z_11;
        local_14 = (_e117 != 0.0);
    } else {
        local_14 = true;
    }
    bool _e121 = local_14;
    shown = _e121;
    bool _e122 = shown;
    if (_e122) {
        bool _e125 = inside_2;
        local_15 = _e125;
    } else {
        local_15 = false;
    }
    bool _e127 = local_15;
    if (_e127) {
        float _e128 = x_39;
        float _e129 = sine_1_4;
        float _e131 = sine_1_4;
        cos_azimuth = ((_e131 > 0.0) ? (_e128 / _e129) : 1.0);
        float _e136 = x_39;
        float _e137 = y_23;
        float _e138 = z_11;
        float _e142 = _group_0_binding_0_fs.star.z;
        float _e146 = _group_0_binding_0_fs.star.w;
        float _e147 = half_sine_between(_e136, _e137, _e138, _e142, _e146);
        half_sine_1 = _e147;
        ground = vec4(0.0);
        bent = 0.0;
        float _e154 = _group_0_binding_0_fs.sky.x;
        int now_2_9 = int(_e154);
        float _e159 = _group_0_binding_0_fs.sky.y;
        int now_3_6 = int(_e159);
        columns_4 = now_2_9;
        rows_5 = now_3_6;
        float _e161 = y_23;
        float _e163 = x_39;
        float _e164 = angle_of(abs(_e161), _e163);
        azimuth_5 = (_e164 / 3.1415927);
        int _e167 = columns_4;
        int _e168 = rows_5;
        float _e169 = row_6;
        bool _e170 = to_ground;
        float _e172 = azimuth_5;
        vec4 _e173 = between_texels(_e167, _e168, _e169, !(_e170), _e172);
        total_2 = _e173;
        bool _e174 = to_ground;
        if (_e174) {
            int _e175 = columns_4;
            int _e176 = rows_5;
            float _e177 = row_6;
            float _e178 = azimuth_5;
            vec4 _e179 = between_texels_2_(_e175, _e176, _e177, _e178);
            ground = _e179;
        }
        float _e183 = _group_0_binding_0_fs.peaks.y;
        if ((int(_e183) >= 0)) {
            vec4 _e187 = total_2;
            float _e188 = half_sine_1;
            float _e192 = _group_0_binding_0_fs.peaks.y;
            vec4 _e194 = phase_of(_e188, int(_e192));
            int _e195 = columns_4;
            int _e196 = rows_5;
            float _e197 = row_6;
            bool _e198 = to_ground;
            float _e200 = azimuth_5;
            vec4 _e201 = between_texels_3_(_e195, _e196, _e197, !(_e198), _e200);
            total_2 = (_e187 + (_e194 * _e201));
        }
        float _e207 = _group_0_binding_0_fs.peaks.z;
        if ((int(_e207) >= 0)) {
            vec4 _e211 = total_2;
            float _e212 = half_sine_1;
            float _e216 = _group_0_binding_0_fs.peaks.z;
            vec4 _e218 = phase_of(_e212, int(_e216));
            int _e219 = columns_4;
            int _e220 = rows_5;
            float _e221 = row_6;
            bool _e222 = to_ground;
            float _e224 = azimuth_5;
            vec4 _e225 = between_texels_4_(_e219, _e220, _e221, !(_e222), _e224);
            total_2 = (_e211 + (_e218 * _e225));
        }
        bool _e228 = to_ground;
        if (_e228) {
            vec4 _e230 = read_albedo(0);
            albedo = _e230;
            float _e234 = _group_0_binding_0_fs.planet_x.w;
            if ((_e234 > 0.5)) {
                float _e240 = _group_0_binding_0_fs.shell.x;
                float _e241 = impact_5;
                float _e246 = _group_0_binding_0_fs.shell.x;
                float _e247 = impact_5;
                cosine_1_3 = sqrt(max(((_e240 - _e241) * (_e246 + _e247)), 0.0));
                float _e253 = cosine_1_3;
                float _e257 = _group_0_binding_0_fs.shell.x;
                cosine_1_3 = (_e253 / _e257);
                float _e259 = x_39;
                float _e260 = y_23;
                float _e261 = z_11;
                float _e262 = sine_1_4;
                float _e263 = impact_5;
                float _e264 = cosine_1_3;
                float _e265 = bent;
                vec4 _e266 = reflectance(_e259, _e260, _e261, _e262, _e263, _e264, _e265);
                albedo = _e266;
            }
            vec4 _e267 = total_2;
            vec4 _e268 = ground;
            vec4 _e269 = albedo;
            total_2 = (_e267 + (_e268 * _e269));
        }
    }
    bool _e272 = shown;
    if (_e272) {
        float _e278 = _group_0_binding_0_fs.planet_z.w;
        local_16 = (_e278 > 0.5);
    } else {
        local_16 = false;
    }
    bool _e282 = local_16;
    if (_e282) {
        bool _e285 = to_ground;
        local_17 = !(_e285);
    } else {
        local_17 = false;
    }
    bool _e288 = local_17;
    if (_e288) {
        vec4 _e289 = total_2;
        vec4 _e290 = star_disc(px_4, py_4);
        total_2 = (_e289 + _e290);
    }
    vec4 _e294 = total_2;
    light_of_found[0] = _e294;
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
    vec4 at = gl_FragCoord;
    vec3 _e1 = light_of(at);
    _fs2p_location0 = vec4(_e1, 1.0);
    return;
}
