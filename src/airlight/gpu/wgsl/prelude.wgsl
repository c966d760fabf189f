fn squared(x: f32) -> f32 { return x * x; }
fn cubed(x: f32) -> f32 { return x * x * x; }
fn whole_quotient(a: i32, b: i32) -> i32 {
  let towards_zero = a / b;
  return select(towards_zero, towards_zero - 1, towards_zero * b != a && (a < 0) != (b < 0));
}
fn whole_rest(a: i32, b: i32) -> i32 { return a - b * whole_quotient(a, b); }
fn sine_of_quarter(x: f32) -> f32 {
  let y = x * x;
  return x + x * y * (-1.6666654611e-1 + y * (8.3321608736e-3 - 1.9515295891e-4 * y));
}
fn cosine_of_quarter(x: f32) -> f32 {
  let y = x * x;
  let tail = y * y * (4.166664568298827e-2 + y * (-1.388731625493765e-3
    + 2.443315711809948e-5 * y));
  return 1.0 - 0.5 * y + tail;
}
fn rest_of_quarter(x: f32, turns: f32) -> f32 {
  return ((x - turns * 1.5703125) - turns * 4.837512969970703e-4) - turns * 7.549789948768648e-8;
}
fn sine(x: f32) -> f32 {
  let turns = round(x * 0.63661977236758);
  let rest = rest_of_quarter(x, turns);
  let quarter = i32(turns) & 3;
  let value = select(sine_of_quarter(rest), cosine_of_quarter(rest), (quarter & 1) == 1);
  return select(value, -value, quarter >= 2);
}
fn cosine(x: f32) -> f32 {
  let turns = round(x * 0.63661977236758);
  let rest = rest_of_quarter(x, turns);
  let quarter = i32(turns) & 3;
  let value = select(cosine_of_quarter(rest), sine_of_quarter(rest), (quarter & 1) == 1);
  return select(value, -value, quarter == 1 || quarter == 2);
}
fn angle_of(y: f32, x: f32) -> f32 {
  let a = abs(x);
  let b = abs(y);
  let slope = min(a, b) / max(max(a, b), 1e-37);
  let steep = slope > 0.41421356;
  let t = select(slope, (slope - 1.0) / (slope + 1.0), steep);
  let z = t * t;
  let tail = -3.33329491539e-1 + z * (1.99777106478e-1 + z * (-1.38776856032e-1
    + z * 8.05374449538e-2));
  let part = select(0.0, 0.785398163397448, steep) + (t + t * z * tail);
  let quarter = select(part, 1.570796326794897 - part, b > a);
  let half = select(quarter, 3.141592653589793 - quarter, x < 0.0);
  return select(half, -half, y < 0.0);
}
fn arc_tangent(x: f32) -> f32 { return angle_of(x, 1.0); }
fn arc_cosine(x: f32) -> f32 { return angle_of(sqrt(max((1.0 - x) * (1.0 + x), 0.0)), x); }
fn arc_sine(x: f32) -> f32 { return angle_of(x, sqrt(max((1.0 - x) * (1.0 + x), 0.0))); }
