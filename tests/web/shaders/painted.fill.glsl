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

uniform highp sampler2D _group_0_binding_1_fs;

layout(location = 0) out vec4 _fs2p_location0;

void main() {
    vec4 at = gl_FragCoord;
    vec4 _e7 = texelFetch(_group_0_binding_1_fs, ivec2(int(at.x), 0), 0);
    vec4 _e10 = _group_0_binding_0_fs.paint;
    _fs2p_location0 = (_e7 * _e10);
    return;
}
