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

uniform highp sampler2D _group_0_binding_1_fs;

layout(location = 0) out vec4 _fs2p_location0;
layout(location = 1) out vec4 _fs2p_location1;

void main() {
    vec4 at = gl_FragCoord;
    vec4 _e9 = texelFetch(_group_0_binding_1_fs, ivec2((int(at.x) & 15), 0), 0);
    vec4 _e12 = _group_0_binding_0_fs.red;
    vec4 color = (_e9 * _e12);
    Layers _tmp_return = Layers(color, color);
    _fs2p_location0 = _tmp_return.first;
    _fs2p_location1 = _tmp_return.second;
    return;
}
