/** The slider of the front page: which frame of front-sky.jpg is shown. */
const ELEVATIONS = [40, 20, 10, 5, 2, 0, -2, -4, -6]; // as in builders/front_sky.py [deg]
const sky = document.querySelector(".front-sky");
const slider = sky.querySelector("input");

function show() {
  const index = Number(slider.value);
  const degrees = ELEVATIONS[index];
  const share = (100 * index) / (ELEVATIONS.length - 1);
  sky.querySelector(".front-frames").style.backgroundPosition = `0 ${share}%`;
  const side = degrees < 0 ? "below" : "above";
  sky.querySelector("output").textContent = `${Math.abs(degrees)}° ${side} the horizon`;
}

slider.addEventListener("input", show);
show();
