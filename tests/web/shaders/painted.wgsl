// A painted sky instead of a computed one: the same two passes, small enough to be checked by hand.
struct Uniforms {
    camera_right: vec4f,
    camera_up: vec4f,
    camera_forward: vec4f,
    frame: vec4f, // width, height, tangent of half the field of view
    display: vec4f, // factor of the exposure
    paint: vec4f,
}
@group(0) @binding(0) var<uniform> uniforms: Uniforms;
@group(0) @binding(1) var colors: texture_2d<f32>;
@group(0) @binding(2) var sky: texture_2d<f32>;

@vertex
fn corners(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fill(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return textureLoad(colors, vec2i(i32(at.x), 0), 0) * uniforms.paint;
}

@fragment
fn picture(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let size = uniforms.frame.xy;
    let x = (2.0 * at.x / size.x - 1.0) * uniforms.frame.z;
    let y = (1.0 - 2.0 * at.y / size.y) * uniforms.frame.z * size.y / size.x;
    let ray = uniforms.camera_forward + x * uniforms.camera_right + y * uniforms.camera_up;
    let height = ray.z / length(ray.xyz);
    let column = clamp(i32((0.5 + 0.5 * height) * 16.0), 0, 15);
    return vec4f((uniforms.display.x * textureLoad(sky, vec2i(column, 0), 0)).rgb, 1.0);
}
