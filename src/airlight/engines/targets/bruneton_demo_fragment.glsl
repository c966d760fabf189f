#version 330
// Sky, sun and bare ground. demo.js sets earth_center and sun_size to the Earth's, so this planet's
// stand here; the camera is relative to the ground below it, in km.
uniform vec3 camera;
uniform float exposure;
uniform vec3 white_point;
uniform vec3 sun_direction;
in vec3 view_ray;
layout(location = 0) out vec4 color;

const vec3 kCenter = CENTER;
const float kRadius = RADIUS;
const float kSunAngularRadius = SUN;
const vec3 kGroundAlbedo = ALBEDO;

vec3 GetSolarLuminance();
vec3 GetSkyLuminance(vec3 camera, vec3 view_ray, float shadow_length, vec3 sun_direction,
    out vec3 transmittance);
vec3 GetSkyLuminanceToPoint(vec3 camera, vec3 point, float shadow_length, vec3 sun_direction,
    out vec3 transmittance);
vec3 GetSunAndSkyIlluminance(vec3 point, vec3 normal, vec3 sun_direction,
    out vec3 sky_irradiance);

void main() {
  vec3 ahead = normalize(view_ray);
  vec3 from = camera - kCenter;
  float r = length(from);
  float rmu = dot(from, ahead);
  float chord = rmu * rmu - (r - kRadius) * (r + kRadius);
  vec3 transmittance;
  vec3 light;
  if (rmu < 0.0 && chord >= 0.0) {
    vec3 point = from + ahead * (-rmu - sqrt(chord));
    vec3 normal = normalize(point);
    vec3 sky;
    vec3 sun = GetSunAndSkyIlluminance(point, normal, sun_direction, sky);
    light = GetSkyLuminanceToPoint(from, point, 0.0, sun_direction, transmittance);
    light += transmittance * kGroundAlbedo * (sun + sky) / 3.14159265358979;
  } else {
    light = GetSkyLuminance(from, ahead, 0.0, sun_direction, transmittance);
    if (dot(ahead, sun_direction) > cos(kSunAngularRadius)) {
      light += transmittance * GetSolarLuminance();
    }
  }
  color = vec4(pow(vec3(1.0) - exp(-light / white_point * exposure), vec3(1.0 / 2.2)), 1.0);
}
