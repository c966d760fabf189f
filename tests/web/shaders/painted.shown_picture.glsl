#version 300 es
// of painted.wgsl c3683d1ea23fc62e, by naga-wasm@30.1.0
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
layout(std140) uniform Frame_block_0Fragment { Frame _group_0_binding_0_fs; };

uniform highp sampler2D _group_0_binding_2_fs;

layout(location = 0) out vec4 _fs2p_location0;

vec4 light_of(vec4 at_3) {
    float _e4 = _group_0_binding_0_fs.screen.z;
    float slope = tan((0.5 * _e4));
    float _e14 = _group_0_binding_0_fs.screen.x;
    float x = ((((2.0 * at_3.x) / _e14) - 1.0) * slope);
    float _e25 = _group_0_binding_0_fs.screen.y;
    float _e33 = _group_0_binding_0_fs.screen.y;
    float _e38 = _group_0_binding_0_fs.screen.x;
    float y = ((((1.0 - ((2.0 * at_3.y) / _e25)) * slope) * _e33) / _e38);
    vec4 _e42 = _group_0_binding_0_fs.camera_forward;
    vec4 _e45 = _group_0_binding_0_fs.camera_right;
    vec4 _e50 = _group_0_binding_0_fs.camera_up;
    vec4 ray = ((_e42 + (x * _e45)) + (y * _e50));
    float height = (ray.z / length(ray.xyz));
    int column = min(max(int(((0.5 + (0.5 * height)) * 16.0)), 0), 15);
    vec4 _e71 = texelFetch(_group_0_binding_2_fs, ivec2(column, 0), 0);
    return vec4(_e71.xyz, 1.0);
}

void main() {
    vec4 at_2 = gl_FragCoord;
    float _e4 = _group_0_binding_0_fs.display.x;
    vec4 _e5 = light_of(at_2);
    _fs2p_location0 = vec4((_e4 * _e5.xyz), 1.0);
    return;
}
