// All the means that the viewer's shaders use, in one small pass.
struct Uniforms {
    counts: vec4f,
    colors: array<vec4f, 4>,
}
@group(0) @binding(0) var<uniform> uniforms: Uniforms;
@group(0) @binding(1) var scalars: texture_2d<f32>;
@group(0) @binding(2) var spectra: texture_2d<f32>;
@group(1) @binding(0) var field: texture_2d<f32>;

const STEPS = array<f32, 4>(1.0, 2.0, 4.0, 8.0);
var<private> kept: array<vec4f, 8>;

struct Pair {
    v0: f32,
    v1: f32,
}

struct Targets {
    @location(0) light: vec4f,
    @location(1) place: vec4f,
}

fn scalar(index: i32) -> f32 {
    return textureLoad(scalars, vec2i(index & 2047, index >> 11), 0).x;
}

fn doubled(x: f32) -> Pair {
    return Pair(x, 2.0 * x);
}

fn fill(room: ptr<function, array<f32, 16>>, count: i32) {
    for (var i: i32 = 0; i < count; i++) {
        (*room)[i] = STEPS[i & 3] * f32(i);
    }
}

fn fill_through(room: ptr<function, array<f32, 16>>, count: i32) {
    fill(room, count);
    if count > 3 {
        (*room)[0] = 0.5;
        return;
    }
    (*room)[1] = 0.25;
}

@vertex
fn corners(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) at: vec4f) -> Targets {
    let count = i32(uniforms.counts.x);
    let index = i32(at.y) * i32(uniforms.counts.y) + i32(at.x);
    var room: array<f32, 16>;
    fill_through(&room, count);
    var sum = 0.0;
    var k = 0;
    while k < count {
        k += 1;
        if k == 3 {
            continue;
        }
        sum += room[k - 1];
    }
    kept[k & 7] = textureLoad(field, vec2i(index & 2047, index >> 11), 0);
    let pair = doubled(scalar(index + 2040));
    let chosen = select(pair.v0, pair.v1, (index & 1) == 1);
    let spectrum = textureLoad(spectra, vec2i(index & 2047, index >> 11), 0);
    let light = uniforms.colors[index & 3] * spectrum + kept[k & 7] * sum;
    return Targets(light, vec4f(f32(index), chosen, sum, at.y));
}
