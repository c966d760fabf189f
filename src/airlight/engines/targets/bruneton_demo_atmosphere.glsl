#version 330
// Light of a planet's air from the textures of airlight bake --layout bruneton-demo.
// Lengths are in km, positions relative to the planet's middle, radiance is at 680, 550, 440 nm.
const float PI = 3.14159265358979;
PLANET
uniform sampler2D transmittance_texture;
uniform sampler3D scattering_texture;
uniform sampler2D irradiance_texture;

// Texture coordinate of x in [0, 1] from the middle of the first texel to that of the last.
float FromUnit(float x, float size) {
  return (0.5 + x * (size - 1.0)) / size;
}

// Squared half chord of a sphere of this radius, less r² (1 - mu²): from differences, for precision.
float HalfChord(float r, float mu, float radius) {
  return (radius - r) * (radius + r) + r * r * mu * mu;
}

float DistanceToTop(float r, float mu) {
  return max(sqrt(max(HalfChord(r, mu, TOP_RADIUS), 0.0)) - r * mu, 0.0);
}

bool MeetsGround(float r, float mu) {
  return mu < 0.0 && HalfChord(r, mu, BOTTOM_RADIUS) >= 0.0;
}

// Distance from the ground's horizon to the top, and from this radius to its horizon.
float LongestAtGround() {
  return sqrt((TOP_RADIUS - BOTTOM_RADIUS) * (TOP_RADIUS + BOTTOM_RADIUS));
}

float DistanceToHorizon(float r) {
  return sqrt(max((r - BOTTOM_RADIUS) * (r + BOTTOM_RADIUS), 0.0));
}

vec3 TransmittanceToTop(float r, float mu) {
  float horizon = DistanceToHorizon(r);
  float longest = LongestAtGround();
  float nearest = TOP_RADIUS - r;
  float x = (DistanceToTop(r, mu) - nearest) / (horizon + longest - nearest);
  return texture(transmittance_texture,
      vec2(FromUnit(x, 256.0), FromUnit(horizon / longest, 64.0))).rgb;
}

// Transmittance between two points of a line, the farther one at (r_end, mu_end).
vec3 TransmittanceBetween(float r, float mu, float r_end, float mu_end, bool ground) {
  vec3 far = ground ? TransmittanceToTop(r_end, -mu_end) : TransmittanceToTop(r, mu);
  vec3 near = ground ? TransmittanceToTop(r, -mu) : TransmittanceToTop(r_end, mu_end);
  return min(far / max(near, vec3(1e-30)), vec3(1.0));
}

float RayleighPhase(float nu) {
  return 3.0 / (16.0 * PI) * (1.0 + nu * nu);
}

float ParticlesPhase(float nu) {
  float g = MIE_PHASE_FUNCTION_G;
  float wide = 1.0 + g * g - 2.0 * g * nu;
  return 3.0 / (8.0 * PI) * (1.0 - g * g) / (2.0 + g * g) * (1.0 + nu * nu) / (wide * sqrt(wide));
}

// Light of the air along a whole line of sight, to the top or to the ground.
vec3 AirLight(float r, float mu, float mu_s, float nu, bool ground) {
  float horizon = DistanceToHorizon(r);
  float longest = LongestAtGround();
  float view;
  if (ground) {
    float nearest = r - BOTTOM_RADIUS;
    float along = -r * mu - sqrt(max(HalfChord(r, mu, BOTTOM_RADIUS), 0.0));
    float x = horizon > nearest ? (along - nearest) / (horizon - nearest) : 0.0;
    view = 0.5 - 0.5 * FromUnit(x, 64.0);
  } else {
    float nearest = TOP_RADIUS - r;
    float x = (DistanceToTop(r, mu) - nearest) / (horizon + longest - nearest);
    view = 0.5 + 0.5 * FromUnit(x, 64.0);
  }
  float shell = TOP_RADIUS - BOTTOM_RADIUS;
  float a = (DistanceToTop(BOTTOM_RADIUS, mu_s) - shell) / (longest - shell);
  float lowest = (DistanceToTop(BOTTOM_RADIUS, MU_S_MIN) - shell) / (longest - shell);
  float sun = FromUnit(max(1.0 - a / lowest, 0.0) / (1.0 + a), 32.0);
  float height = FromUnit(horizon / longest, 32.0);
  // The width holds eight pictures side by side, one for each angle to the sun.
  float angle = 0.5 * (nu + 1.0) * 7.0;
  float low = min(floor(angle), 6.0);
  vec4 texel = mix(
      texture(scattering_texture, vec3((low + sun) / 8.0, view, height)),
      texture(scattering_texture, vec3((low + 1.0 + sun) / 8.0, view, height)),
      angle - low);
  vec3 particles = texel.r > 0.0 ? texel.rgb * (texel.a / texel.r) * MIE_COLOURS : vec3(0.0);
  return texel.rgb * RayleighPhase(nu) + particles * ParticlesPhase(nu);
}

// Moves a camera in space to where its line of sight enters the air; false where it misses it.
bool EnterAir(inout vec3 camera, vec3 view_ray) {
  float r = length(camera);
  if (r <= TOP_RADIUS) return true;
  float mu = dot(camera, view_ray) / r;
  float chord = HalfChord(r, mu, TOP_RADIUS);
  if (mu > 0.0 || chord < 0.0) return false;
  camera += view_ray * (-r * mu - sqrt(chord));
  return true;
}

vec3 GetSolarRadiance() {
  return SOLAR_IRRADIANCE / (PI * SUN_ANGULAR_RADIUS * SUN_ANGULAR_RADIUS);
}

// Light scattered along a line of sight to space or to the ground, without the first
// shadow_length of it, which lies in shadow; and the transmittance, 0 before the ground.
vec3 GetSkyRadiance(vec3 camera, vec3 view_ray, float shadow_length, vec3 sun_direction,
    out vec3 transmittance) {
  transmittance = vec3(1.0);
  if (!EnterAir(camera, view_ray)) return vec3(0.0);
  float r = min(length(camera), TOP_RADIUS);
  float mu = dot(camera, view_ray) / r;
  float mu_s = dot(camera, sun_direction) / r;
  float nu = dot(view_ray, sun_direction);
  bool ground = MeetsGround(r, mu);
  transmittance = ground ? vec3(0.0) : TransmittanceToTop(r, mu);
  if (shadow_length <= 0.0) return AirLight(r, mu, mu_s, nu, ground);
  float d = shadow_length;
  float r_d = clamp(sqrt(d * d + 2.0 * r * mu * d + r * r), BOTTOM_RADIUS, TOP_RADIUS);
  float mu_d = clamp((r * mu + d) / r_d, -1.0, 1.0);
  return TransmittanceBetween(r, mu, r_d, mu_d, ground) *
      AirLight(r_d, mu_d, (r * mu_s + d * nu) / r_d, nu, ground);
}

// Light scattered between camera and point, without the last shadow_length of the way.
vec3 GetSkyRadianceToPoint(vec3 camera, vec3 point, float shadow_length, vec3 sun_direction,
    out vec3 transmittance) {
  transmittance = vec3(1.0);
  vec3 view_ray = normalize(point - camera);
  if (!EnterAir(camera, view_ray)) return vec3(0.0);
  float r = min(length(camera), TOP_RADIUS);
  float mu = dot(camera, view_ray) / r;
  float mu_s = dot(camera, sun_direction) / r;
  float nu = dot(view_ray, sun_direction);
  bool ground = MeetsGround(r, mu);
  float way = length(point - camera);
  float r_end = clamp(sqrt(way * way + 2.0 * r * mu * way + r * r), BOTTOM_RADIUS, TOP_RADIUS);
  transmittance =
      TransmittanceBetween(r, mu, r_end, clamp((r * mu + way) / r_end, -1.0, 1.0), ground);
  float d = max(way - shadow_length, 0.0);
  float r_d = clamp(sqrt(d * d + 2.0 * r * mu * d + r * r), BOTTOM_RADIUS, TOP_RADIUS);
  float mu_d = clamp((r * mu + d) / r_d, -1.0, 1.0);
  vec3 behind = TransmittanceBetween(r, mu, r_d, mu_d, ground) *
      AirLight(r_d, mu_d, (r * mu_s + d * nu) / r_d, nu, ground);
  return max(AirLight(r, mu, mu_s, nu, ground) - behind, vec3(0.0));
}

// Irradiance of a surface by the sun, and by the sky.
vec3 GetSunAndSkyIrradiance(vec3 point, vec3 normal, vec3 sun_direction,
    out vec3 sky_irradiance) {
  float r = length(point);
  float mu_s = dot(point, sun_direction) / r;
  vec2 at = vec2(FromUnit(0.5 * (mu_s + 1.0), 64.0),
      FromUnit((r - BOTTOM_RADIUS) / (TOP_RADIUS - BOTTOM_RADIUS), 16.0));
  sky_irradiance = texture(irradiance_texture, at).rgb * 0.5 * (1.0 + dot(normal, point) / r);
  float dip = BOTTOM_RADIUS / r;
  float above = mu_s + sqrt(max(1.0 - dip * dip, 0.0));
  float disc = dip * SUN_ANGULAR_RADIUS;
  return SOLAR_IRRADIANCE * TransmittanceToTop(r, mu_s) * smoothstep(-disc, disc, above) *
      max(dot(normal, sun_direction), 0.0);
}

// The same in linear sRGB, for a display: radiance times one factor for each wavelength.
vec3 GetSolarLuminance() {
  return GetSolarRadiance() * SUN_SPECTRAL_RADIANCE_TO_LUMINANCE;
}

vec3 GetSkyLuminance(vec3 camera, vec3 view_ray, float shadow_length, vec3 sun_direction,
    out vec3 transmittance) {
  return GetSkyRadiance(camera, view_ray, shadow_length, sun_direction, transmittance) *
      SKY_SPECTRAL_RADIANCE_TO_LUMINANCE;
}

vec3 GetSkyLuminanceToPoint(vec3 camera, vec3 point, float shadow_length, vec3 sun_direction,
    out vec3 transmittance) {
  return GetSkyRadianceToPoint(camera, point, shadow_length, sun_direction, transmittance) *
      SKY_SPECTRAL_RADIANCE_TO_LUMINANCE;
}

vec3 GetSunAndSkyIlluminance(vec3 point, vec3 normal, vec3 sun_direction,
    out vec3 sky_irradiance) {
  vec3 sun = GetSunAndSkyIrradiance(point, normal, sun_direction, sky_irradiance);
  sky_irradiance *= SKY_SPECTRAL_RADIANCE_TO_LUMINANCE;
  return sun * SUN_SPECTRAL_RADIANCE_TO_LUMINANCE;
}
