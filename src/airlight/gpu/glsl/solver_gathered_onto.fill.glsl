#version 300 es
// of solver_gathered_onto.wgsl f5a85d602ef03eb8, by naga-wasm@30.1.0
precision highp float;
precision highp int;

struct Solve {
    vec4 counts;
    vec4 more_counts;
    vec4 most_counts;
    vec4 measures;
    vec4 mu_shape;
    vec4 mu_start;
    vec4 weight_shape;
    vec4 weight_start;
    vec4 flux_shape;
    vec4 flux_start;
    vec4 start_shape;
    vec4 start_start;
    vec4 total_shape;
    vec4 total_start;
    vec4 end_shape;
    vec4 end_start;
    vec4 radius_shape;
    vec4 radius_start;
    vec4 mu_along_shape;
    vec4 mu_along_start;
    vec4 turn_shape;
    vec4 turn_start;
    vec4 amount_shape;
    vec4 amount_start;
    vec4 column_shape;
    vec4 column_start;
    vec4 sun_cosines_shape;
    vec4 sun_cosines_start;
    vec4 row_shape;
    vec4 row_start;
    vec4 place_shape;
    vec4 place_start;
    vec4 cosines_shape;
    vec4 cosines_start;
    vec4 multiples_shape;
    vec4 multiples_start;
    vec4 harmonic_shape;
    vec4 harmonic_start;
    vec4 ahead_shape;
    vec4 ahead_start;
    vec4 back_shape;
    vec4 back_start;
    vec4 ratios_shape;
    vec4 ratios_start;
    vec4 lift_shape;
    vec4 lift_start;
    vec4 level_shape;
    vec4 level_start;
    vec4 extinction_shape;
    vec4 extinction_start;
    vec4 moments_shape;
    vec4 moments_start;
    vec4 albedo_shape;
    vec4 albedo_start;
};
struct Span {
    vec4 texels;
};
layout(std140) uniform Solve_block_0Fragment { Solve _group_0_binding_0_fs; };

layout(std140) uniform Span_block_1Fragment { Span _group_0_binding_1_fs; };

uniform highp sampler2D _group_0_binding_3_fs;

uniform highp sampler2D _group_0_binding_4_fs;

uniform highp sampler2D _group_0_binding_5_fs;

layout(location = 0) out vec4 _fs2p_location0;

ivec2 texel_place(int index) {
    return ivec2((index & 2047), (index >> 11u));
}

float read_projections_table(int index_1) {
    ivec2 _e4 = texel_place((index_1 >> 2u));
    vec4 _e6 = texelFetch(_group_0_binding_3_fs, _e4, 0);
    return _e6[(index_1 & 3)];
}

vec4 read_azimuthals_table(int index_2) {
    ivec2 _e2 = texel_place(index_2);
    vec4 _e4 = texelFetch(_group_0_binding_4_fs, _e2, 0);
    return _e4;
}

vec4 read_first_table(int index_3) {
    ivec2 _e2 = texel_place(index_3);
    vec4 _e4 = texelFetch(_group_0_binding_5_fs, _e2, 0);
    return _e4;
}

float squared(float x) {
    return (x * x);
}

float cubed(float x_1) {
    return ((x_1 * x_1) * x_1);
}

int whole_quotient(int a, int b) {
    bool local_1 = false;
    int towards_zero = (a / b);
    if (((towards_zero * b) != a)) {
        local_1 = ((a < 0) != (b < 0));
    } else {
        local_1 = false;
    }
    bool _e15 = local_1;
    return (_e15 ? (towards_zero - 1) : towards_zero);
}

int whole_rest(int a_1, int b_1) {
    int _e2 = whole_quotient(a_1, b_1);
    return (a_1 - (b_1 * _e2));
}

float sine_of_quarter(float x_2) {
    float y_1 = (x_2 * x_2);
    return (x_2 + ((x_2 * y_1) * (-0.16666655 + (y_1 * (0.008332161 - (0.00019515296 * y_1))))));
}

float cosine_of_quarter(float x_3) {
    float y_2 = (x_3 * x_3);
    float tail = ((y_2 * y_2) * (0.041666646 + (y_2 * (-0.0013887316 + (2.4433157e-5 * y_2)))));
    return ((1.0 - (0.5 * y_2)) + tail);
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
    bool local_2 = false;
    float turns_2 = roundEven((x_6 * 0.63661975));
    float _e4 = rest_of_quarter(x_6, turns_2);
    int quarter_1 = (int(turns_2) & 3);
    float _e8 = cosine_of_quarter(_e4);
    float _e9 = sine_of_quarter(_e4);
    float value_1 = (((quarter_1 & 1) == 1) ? _e9 : _e8);
    if (!((quarter_1 == 1))) {
        local_2 = (quarter_1 == 2);
    } else {
        local_2 = true;
    }
    bool _e24 = local_2;
    return (_e24 ? -(value_1) : value_1);
}

float angle_of(float y, float x_7) {
    float a_3 = abs(x_7);
    float b_2 = abs(y);
    float slope = (min(a_3, b_2) / max(max(a_3, b_2), 1e-37));
    bool steep = (slope > 0.41421357);
    float t = (steep ? ((slope - 1.0) / (slope + 1.0)) : slope);
    float z = (t * t);
    float tail_1 = (-0.3333295 + (z * (0.19977711 + (z * (-0.13877685 + (z * 0.080537446))))));
    float part = ((steep ? 0.7853982 : 0.0) + (t + ((t * z) * tail_1)));
    float quarter_2 = ((b_2 > a_3) ? (1.5707964 - part) : part);
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

int degree_of(int index_4) {
    return int(((0.5 * (sqrt(((8.0 * float(index_4)) + 1.0)) - 1.0)) + 0.001));
}

vec4 gathered_moment(int index_5) {
    int nodes = 0;
    int width = 0;
    vec4 total = vec4(0.0);
    int node = 0;
    int i = 0;
    int j = 0;
    int weights = 0;
    int a_2 = 0;
    int at = 0;
    int term = 0;
    int l = 0;
    int m = 0;
    int ray = 0;
    float _e17 = _group_0_binding_0_fs.counts.x;
    float _e22 = _group_0_binding_0_fs.counts.z;
    nodes = (int(_e17) * int(_e22));
    float _e28 = _group_0_binding_0_fs.more_counts.x;
    width = (int(_e28) + 1);
    total = vec4(0.0);
    int _e34 = nodes;
    float _e38 = _group_0_binding_0_fs.more_counts.y;
    if ((index_5 >= (_e34 * int(_e38)))) {
        int _e42 = nodes;
        float _e46 = _group_0_binding_0_fs.more_counts.y;
        node = (index_5 - (_e42 * int(_e46)));
        int _e50 = node;
        float _e54 = _group_0_binding_0_fs.counts.z;
        int _e56 = whole_quotient(_e50, int(_e54));
        int _e57 = node;
        float _e61 = _group_0_binding_0_fs.counts.z;
        int _e63 = whole_rest(_e57, int(_e61));
        i = _e56;
        j = _e63;
        float _e67 = _group_0_binding_0_fs.counts.x;
        float _e72 = _group_0_binding_0_fs.counts.y;
        float _e78 = _group_0_binding_0_fs.more_counts.y;
        int _e81 = i;
        float _e85 = _group_0_binding_0_fs.counts.y;
        weights = (((int(_e67) * int(_e72)) * int(_e78)) + (_e81 * int(_e85)));
        float _e92 = _group_0_binding_0_fs.counts.y;
        int end_3_ = int(_e92);
        a_2 = 0;
        bool loop_init = true;
        while(true) {
            if (!loop_init) {
                int _e228 = a_2;
                a_2 = (_e228 + 1);
            }
            loop_init = false;
            int _e95 = a_2;
            if (((_e95 + 3) < end_3_)) {
            } else {
                break;
            }
            {
                int _e99 = i;
                float _e103 = _group_0_binding_0_fs.counts.y;
                int _e106 = a_2;
                float _e111 = _group_0_binding_0_fs.counts.z;
                int _e114 = j;
                int _e116 = width;
                at = (((((_e99 * int(_e103)) + _e106) * int(_e111)) + _e114) * _e116);
                vec4 _e118 = total;
                int _e119 = weights;
                int _e120 = a_2;
                float _e122 = read_projections_table((_e119 + _e120));
                int _e123 = at;
                vec4 _e126 = read_azimuthals_table((1 * _e123));
                total = (_e118 + (_e122 * _e126));
                int _e129 = a_2;
                a_2 = (_e129 + 1);
                int _e132 = i;
                float _e136 = _group_0_binding_0_fs.counts.y;
                int _e139 = a_2;
                float _e144 = _group_0_binding_0_fs.counts.z;
                int _e147 = j;
                int _e149 = width;
                at = (((((_e132 * int(_e136)) + _e139) * int(_e144)) + _e147) * _e149);
                vec4 _e151 = total;
                int _e152 = weights;
                int _e153 = a_2;
                float _e155 = read_projections_table((_e152 + _e153));
                int _e156 = at;
                vec4 _e159 = read_azimuthals_table((1 * _e156));
                total = (_e151 + (_e155 * _e159));
                int _e162 = a_2;
                a_2 = (_e162 + 1);
                int _e165 = i;
                float _e169 = _group_0_binding_0_fs.counts.y;
                int _e172 = a_2;
                float _e177 = _group_0_binding_0_fs.counts.z;
                int _e180 = j;
                int _e182 = width;
                at = (((((_e165 * int(_e169)) + _e172) * int(_e177)) + _e180) * _e182);
                vec4 _e184 = total;
                int _e185 = weights;
                int _e186 = a_2;
                float _e188 = read_projections_table((_e185 + _e186));
                int _e189 = at;
                vec4 _e192 = read_azimuthals_table((1 * _e189));
                total = (_e184 + (_e188 * _e192));
                int _e195 = a_2;
                a_2 = (_e195 + 1);
                int _e198 = i;
                float _e202 = _group_0_binding_0_fs.counts.y;
                int _e205 = a_2;
                float _e210 = _group_0_binding_0_fs.counts.z;
                int _e213 = j;
                int _e215 = width;
                at = (((((_e198 * int(_e202)) + _e205) * int(_e210)) + _e213) * _e215);
                vec4 _e217 = total;
                int _e218 = weights;
                int _e219 = a_2;
                float _e221 = read_projections_table((_e218 + _e219));
                int _e222 = at;
                vec4 _e225 = read_azimuthals_table((1 * _e222));
                total = (_e217 + (_e221 * _e225));
            }
        }
        bool loop_init_1 = true;
        while(true) {
            if (!loop_init_1) {
                int _e263 = a_2;
                a_2 = (_e263 + 1);
            }
            loop_init_1 = false;
            int _e231 = a_2;
            if ((_e231 < end_3_)) {
            } else {
                break;
            }
            {
                int _e233 = i;
                float _e237 = _group_0_binding_0_fs.counts.y;
                int _e240 = a_2;
                float _e245 = _group_0_binding_0_fs.counts.z;
                int _e248 = j;
                int _e250 = width;
                at = (((((_e233 * int(_e237)) + _e240) * int(_e245)) + _e248) * _e250);
                vec4 _e252 = total;
                int _e253 = weights;
                int _e254 = a_2;
                float _e256 = read_projections_table((_e253 + _e254));
                int _e257 = at;
                vec4 _e260 = read_azimuthals_table((1 * _e257));
                total = (_e252 + (_e256 * _e260));
            }
        }
        vec4 _e266 = total;
        return _e266;
    }
    float _e270 = _group_0_binding_0_fs.more_counts.y;
    int _e272 = whole_quotient(index_5, int(_e270));
    float _e276 = _group_0_binding_0_fs.more_counts.y;
    int _e278 = whole_rest(index_5, int(_e276));
    node = _e272;
    term = _e278;
    int _e279 = node;
    float _e283 = _group_0_binding_0_fs.counts.z;
    int _e285 = whole_quotient(_e279, int(_e283));
    int _e286 = node;
    float _e290 = _group_0_binding_0_fs.counts.z;
    int _e292 = whole_rest(_e286, int(_e290));
    i = _e285;
    j = _e292;
    int _e293 = term;
    int _e294 = degree_of(_e293);
    l = _e294;
    int _e295 = term;
    int _e296 = l;
    int _e297 = l;
    int _e302 = whole_quotient((_e296 * (_e297 + 1)), 2);
    m = (_e295 - _e302);
    float _e307 = _group_0_binding_0_fs.counts.y;
    int end_8_ = int(_e307);
    a_2 = 0;
    bool loop_init_2 = true;
    while(true) {
        if (!loop_init_2) {
            int _e479 = a_2;
            a_2 = (_e479 + 1);
        }
        loop_init_2 = false;
        int _e310 = a_2;
        if (((_e310 + 3) < end_8_)) {
        } else {
            break;
        }
        {
            int _e314 = i;
            float _e318 = _group_0_binding_0_fs.counts.y;
            int _e321 = a_2;
            ray = ((_e314 * int(_e318)) + _e321);
            int _e323 = ray;
            float _e327 = _group_0_binding_0_fs.counts.z;
            int _e330 = j;
            int _e332 = width;
            int _e334 = m;
            at = ((((_e323 * int(_e327)) + _e330) * _e332) + _e334);
            vec4 _e336 = total;
            int _e337 = ray;
            float _e341 = _group_0_binding_0_fs.more_counts.y;
            int _e344 = term;
            float _e346 = read_projections_table(((_e337 * int(_e341)) + _e344));
            int _e347 = at;
            vec4 _e350 = read_azimuthals_table((1 * _e347));
            total = (_e336 + (_e346 * _e350));
            int _e353 = a_2;
            a_2 = (_e353 + 1);
            int _e356 = i;
            float _e360 = _group_0_binding_0_fs.counts.y;
            int _e363 = a_2;
            ray = ((_e356 * int(_e360)) + _e363);
            int _e365 = ray;
            float _e369 = _group_0_binding_0_fs.counts.z;
            int _e372 = j;
            int _e374 = width;
            int _e376 = m;
            at = ((((_e365 * int(_e369)) + _e372) * _e374) + _e376);
            vec4 _e378 = total;
            int _e379 = ray;
            float _e383 = _group_0_binding_0_fs.more_counts.y;
            int _e386 = term;
            float _e388 = read_projections_table(((_e379 * int(_e383)) + _e386));
            int _e389 = at;
            vec4 _e392 = read_azimuthals_table((1 * _e389));
            total = (_e378 + (_e388 * _e392));
            int _e395 = a_2;
            a_2 = (_e395 + 1);
            int _e398 = i;
            float _e402 = _group_0_binding_0_fs.counts.y;
            int _e405 = a_2;
            ray = ((_e398 * int(_e402)) + _e405);
            int _e407 = ray;
            float _e411 = _group_0_binding_0_fs.counts.z;
            int _e414 = j;
            int _e416 = width;
            int _e418 = m;
            at = ((((_e407 * int(_e411)) + _e414) * _e416) + _e418);
            vec4 _e420 = total;
            int _e421 = ray;
            float _e425 = _group_0_binding_0_fs.more_counts.y;
            int _e428 = term;
            float _e430 = read_projections_table(((_e421 * int(_e425)) + _e428));
            int _e431 = at;
            vec4 _e434 = read_azimuthals_table((1 * _e431));
            total = (_e420 + (_e430 * _e434));
            int _e437 = a_2;
            a_2 = (_e437 + 1);
            int _e440 = i;
            float _e444 = _group_0_binding_0_fs.counts.y;
            int _e447 = a_2;
            ray = ((_e440 * int(_e444)) + _e447);
            int _e449 = ray;
            float _e453 = _group_0_binding_0_fs.counts.z;
            int _e456 = j;
            int _e458 = width;
            int _e460 = m;
            at = ((((_e449 * int(_e453)) + _e456) * _e458) + _e460);
            vec4 _e462 = total;
            int _e463 = ray;
            float _e467 = _group_0_binding_0_fs.more_counts.y;
            int _e470 = term;
            float _e472 = read_projections_table(((_e463 * int(_e467)) + _e470));
            int _e473 = at;
            vec4 _e476 = read_azimuthals_table((1 * _e473));
            total = (_e462 + (_e472 * _e476));
        }
    }
    bool loop_init_3 = true;
    while(true) {
        if (!loop_init_3) {
            int _e523 = a_2;
            a_2 = (_e523 + 1);
        }
        loop_init_3 = false;
        int _e482 = a_2;
        if ((_e482 < end_8_)) {
        } else {
            break;
        }
        {
            int _e484 = i;
            float _e488 = _group_0_binding_0_fs.counts.y;
            int _e491 = a_2;
            ray = ((_e484 * int(_e488)) + _e491);
            int _e493 = ray;
            float _e497 = _group_0_binding_0_fs.counts.z;
            int _e500 = j;
            int _e502 = width;
            int _e504 = m;
            at = ((((_e493 * int(_e497)) + _e500) * _e502) + _e504);
            vec4 _e506 = total;
            int _e507 = ray;
            float _e511 = _group_0_binding_0_fs.more_counts.y;
            int _e514 = term;
            float _e516 = read_projections_table(((_e507 * int(_e511)) + _e514));
            int _e517 = at;
            vec4 _e520 = read_azimuthals_table((1 * _e517));
            total = (_e506 + (_e516 * _e520));
        }
    }
    vec4 _e526 = total;
    return _e526;
}

vec4 gathered_onto(int index_6) {
    vec4 _e3 = read_first_table((1 * index_6));
    vec4 _e4 = gathered_moment(index_6);
    return (_e3 + _e4);
}

vec4 texel(int index_7) {
    vec4 _e1 = gathered_onto(index_7);
    return _e1;
}

void main() {
    vec4 position = gl_FragCoord;
    bool local = false;
    int index_8 = ((int(position.y) * 2048) + int(position.x));
    float _e11 = _group_0_binding_1_fs.texels.x;
    int first_1 = int(_e11);
    float _e16 = _group_0_binding_1_fs.texels.y;
    int last = (int(_e16) - 1);
    vec4 _e21 = texel(min(max(index_8, first_1), last));
    if (!((index_8 < first_1))) {
        local = (index_8 > last);
    } else {
        local = true;
    }
    bool _e28 = local;
    if (_e28) {
        discard;
    }
    _fs2p_location0 = _e21;
    return;
}
