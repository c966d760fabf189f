#version 300 es
// of painted.wgsl 3d65f4f0289b678c, by naga-wasm@30.1.0
precision highp float;
precision highp int;

struct Uniforms {
    vec4 camera_right;
    vec4 camera_up;
    vec4 camera_forward;
    vec4 frame;
    vec4 display;
    vec4 paint;
};
layout(std140) uniform Uniforms_block_0Fragment { Uniforms _group_0_binding_0_fs; };

uniform highp sampler2D _group_0_binding_2_fs;

layout(location = 0) out vec4 _fs2p_location0;

void main() {
    vec4 at_1 = gl_FragCoord;
    vec4 _e3 = _group_0_binding_0_fs.frame;
    vec2 size = _e3.xy;
    float _e15 = _group_0_binding_0_fs.frame.z;
    float x = ((((2.0 * at_1.x) / size.x) - 1.0) * _e15);
    float _e27 = _group_0_binding_0_fs.frame.z;
    float y = ((((1.0 - ((2.0 * at_1.y) / size.y)) * _e27) * size.y) / size.x);
    vec4 _e35 = _group_0_binding_0_fs.camera_forward;
    vec4 _e38 = _group_0_binding_0_fs.camera_right;
    vec4 _e43 = _group_0_binding_0_fs.camera_up;
    vec4 ray = ((_e35 + (x * _e38)) + (y * _e43));
    float height = (ray.z / length(ray.xyz));
    int column = min(max(int(((0.5 + (0.5 * height)) * 16.0)), 0), 15);
    float _e63 = _group_0_binding_0_fs.display.x;
    vec4 _e68 = texelFetch(_group_0_binding_2_fs, ivec2(column, 0), 0);
    _fs2p_location0 = vec4((_e63 * _e68).xyz, 1.0);
    return;
}
