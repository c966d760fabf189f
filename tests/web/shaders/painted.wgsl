//UNIFORMS
// A painted sky instead of a computed one: the same passes, small enough to be checked by hand.
@group(0) @binding(1) var fields: texture_2d<f32>;
@group(0) @binding(2) var air: texture_2d<f32>;

struct Layers {
    @location(0) first: vec4f,
    @location(1) second: vec4f,
}

@vertex
fn corners(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn sky_air(@builtin(position) at: vec4f) -> Layers {
    let color = textureLoad(fields, vec2i(i32(at.x) & 15, 0), 0) * frame.red;
    return Layers(color, color);
}

fn light_of(at: vec4f) -> vec4f {
    let slope = tan(0.5 * frame.screen.z);
    let x = (2.0 * at.x / frame.screen.x - 1.0) * slope;
    let y = (1.0 - 2.0 * at.y / frame.screen.y) * slope * frame.screen.y / frame.screen.x;
    let ray = frame.camera_forward + x * frame.camera_right + y * frame.camera_up;
    let height = ray.z / length(ray.xyz);
    let column = clamp(i32((0.5 + 0.5 * height) * 16.0), 0, 15);
    return vec4f(textureLoad(air, vec2i(column, 0), 0).rgb, 1.0);
}

@fragment
fn linear_picture(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return light_of(at);
}

@fragment
fn shown_picture(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return vec4f(frame.display.x * light_of(at).rgb, 1.0);
}
