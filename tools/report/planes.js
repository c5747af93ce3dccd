// Pixels from text: the other half of plane.cpp.

async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function halfValue(bits) {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? 2 ** (exponent - 15) * (1 + fraction / 1024) : 2 ** -24 * fraction);
}

const HALVES = Float32Array.from({ length: 65536 }, (_, bits) => halfValue(bits));

// {width, height, channels, values}: the values of one channel stand together.
async function openPlane(plane) {
  const bytes = await inflate(plane.data);
  const count = bytes.length / 2;
  const values = new Float32Array(count);
  let high = 0;
  let low = 0;
  for (let i = 0; i < count; ++i) {
    high = (high + bytes[i]) & 255;
    low = (low + bytes[count + i]) & 255;
    values[i] = HALVES[(high << 8) | low] * plane.scale;
  }
  return { width: plane.width, height: plane.height, channels: plane.channels, values };
}

function valueAt(plane, pixel, channel) {
  return plane.values[channel * plane.width * plane.height + pixel];
}

// ---- As tools/view/levels.cpp and host/image/color.cpp show a target

function toneMap(radiance) {
  const knee = 0.8;
  if (!(radiance > 0)) return 0;
  if (radiance <= knee) return radiance;
  return knee + (1 - knee) * (1 - 1 / (1 + (radiance - knee) / (1 - knee)));
}

function linearToSrgb(linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * linear ** (1 / 2.4) - 0.055;
}

function shownLevel(value, channel, levels, brighter) {
  let level = (value * levels.scale[channel] + levels.offset[channel]) * brighter;
  if (levels.toneMap) level = toneMap(level);
  level = Math.min(Math.max(level, 0), 1);
  return 255 * (levels.encode ? linearToSrgb(level) : level);
}

// channel: 0 colour, 1 to 4 one of them as grey. NaN and infinity are magenta.
function paintLevels(plane, levels, channel, stops) {
  const pixels = plane.width * plane.height;
  const image = new ImageData(plane.width, plane.height);
  const chosen = channel || levels.channel;
  for (let i = 0; i < pixels; ++i)
    for (let c = 0; c < 3; ++c) {
      const from = chosen ? chosen - 1 : c;
      const value = from < plane.channels ? valueAt(plane, i, from) : 0;
      image.data[4 * i + c] = Number.isFinite(value) ? shownLevel(value, from, levels, 2 ** stops) : c === 1 ? 0 : 255;
      image.data[4 * i + 3] = 255;
    }
  return image;
}

// From a millionth (black) to all (white) of the mean: steps of plasma's colours, which are evenly bright.
const RAMP = [[0, 0, 0], [77, 5, 161], [168, 36, 145], [235, 105, 87], [252, 181, 43], [255, 255, 217]];
const RAMP_LOWEST = -6;

function rampColour(error) {
  if (!Number.isFinite(error)) return [0, 255, 0];
  const level = error > 0 ? Math.min(Math.max(1 - Math.log10(error) / RAMP_LOWEST, 0), 1) : 0;
  const place = level * (RAMP.length - 1);
  const step = Math.min(Math.floor(place), RAMP.length - 2);
  return RAMP[step].map((from, c) => from + (place - step) * (RAMP[step + 1][c] - from));
}

function largestDifference(plane, pixel, channel) {
  if (channel && channel <= plane.channels) return Math.abs(valueAt(plane, pixel, channel - 1));
  let largest = 0;
  for (let c = 0; c < Math.min(plane.channels, 3); ++c) {
    const value = Math.abs(valueAt(plane, pixel, c));
    if (!(value <= largest)) largest = value;
  }
  return largest;
}

function paintDifference(plane, channel) {
  const image = new ImageData(plane.width, plane.height);
  for (let i = 0; i < plane.width * plane.height; ++i) image.data.set([...rampColour(largestDifference(plane, i, channel)), 255], 4 * i);
  return image;
}
