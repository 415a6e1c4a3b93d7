// A small scene with true shadows, so that the fixture shows what the page is for: spheres on a
// floor under sphere lights, seen from above at a slant.

type V = [number, number, number];
const sub = (a: V, b: V): V => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: V, b: V): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const along = (o: V, d: V, t: number): V => [o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]];
const unit = (a: V): V => { const l = Math.hypot(...a); return [a[0] / l, a[1] / l, a[2] / l]; };
const cross = (a: V, b: V): V => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

interface Ball { centre: V; radius: number; colour: V }
export interface Lamp { name: string; kind: string; centre: V; radius: number; power: number }

const balls: Ball[] = [
  {centre: [0, 1, -0.6], radius: 1, colour: [0.7, 0.7, 0.72]},
  {centre: [-1.75, 0.6, 0.35], radius: 0.6, colour: [0.72, 0.2, 0.15]},
  {centre: [1.65, 0.48, 0.45], radius: 0.48, colour: [0.18, 0.33, 0.62]},
  {centre: [0.55, 0.3, 1.2], radius: 0.3, colour: [0.8, 0.55, 0.16]},
  {centre: [-0.7, 0.22, 1.55], radius: 0.22, colour: [0.25, 0.5, 0.2]},
  {centre: [1.45, 1.55, 0.35], radius: 0.25, colour: [0.85, 0.85, 0.85]},
];

export const lamps: Lamp[] = [
  {name: 'key', kind: 'sphere', centre: [-6, 8, 4], radius: 1.3, power: 0.75},
  {name: 'fill', kind: 'sphere', centre: [5, 6, 5], radius: 0.7, power: 0.3},
];

function meet(origin: V, direction: V): {point: V; normal: V; colour: V; ball: Ball | null} | null {
  let nearest = Infinity, hit: Ball | null = null;
  for (const ball of balls) {
    const c = sub(ball.centre, origin), b = dot(c, direction), d = b * b - dot(c, c) + ball.radius ** 2;
    if (d < 0) continue;
    const t = b - Math.sqrt(d);
    if (t <= 0 || t >= nearest) continue;
    nearest = t;
    hit = ball;
  }
  const floor = -origin[1] / direction[1];
  if (floor > 0 && floor < nearest && floor < 13)
    return {point: along(origin, direction, floor), normal: [0, 1, 0], colour: [0.72, 0.7, 0.66], ball: null};
  if (!hit) return null;
  const point = along(origin, direction, nearest);
  return {point, normal: unit(sub(point, hit.centre)), colour: hit.colour, ball: hit};
}

/** Least clearance of the ray to the lamp's centre over the lamp's own angle; below 0 inside. */
function clearance(point: V, own: Ball | null, lamp: Lamp): number {
  const to = sub(lamp.centre, point), distance = Math.hypot(...to), direction = unit(to);
  let least = Infinity;
  for (const ball of balls) {
    const c = sub(ball.centre, point), t = dot(c, direction);
    if (ball === own || t <= 0 || t > distance) continue;
    const off = Math.sqrt(Math.max(0, dot(c, c) - t * t)) - ball.radius;
    least = Math.min(least, off * distance / (t * lamp.radius));
  }
  return least;
}

function seen(point: V, own: Ball | null, lamp: Lamp, samples: number): number {
  const axis = unit(sub(lamp.centre, point)), side = unit(cross(axis, [0.3, 1, 0.2])), up = cross(axis, side);
  let count = 0;
  for (let i = 0; i < samples; ++i) {
    const r = lamp.radius * Math.sqrt((i + 0.5) / samples), a = 2.399963 * i;
    const target = along(along(lamp.centre, side, r * Math.cos(a)), up, r * Math.sin(a));
    const to = sub(target, point), distance = Math.hypot(...to), direction = unit(to);
    const blocked = balls.some(ball => {
      const c = sub(ball.centre, point), b = dot(c, direction), d = b * b - dot(c, c) + ball.radius ** 2;
      return ball !== own && d > 0 && b > 0 && b < distance;
    });
    if (!blocked) ++count;
  }
  return count / samples;
}

const cubic = (x: number): number => { const t = Math.min(1, Math.max(0, x)); return t * t * (3 - 2 * t); };

/** The visible fraction by a name of the methods; `reference` is 256 points of the lamp. */
export function fraction(method: string, point: V, own: Ball | null, lamp: Lamp): number {
  const x = (): number => clearance(point, own, lamp);
  switch (method) {
    case 'hard': return x() > 0 ? 1 : 0;
    case 'parker': return cubic(x() / 2);
    case 'sdf-classic': return Math.min(1, Math.max(0, x()));
    case 'sdf-improved': return cubic(x());
    case 'sdf-inner': return cubic((x() + 1) / 2);
    case 'heckbert-herf': return seen(point, own, lamp, 16);
    case 'area': return seen(point, own, lamp, 64);
    default: return seen(point, own, lamp, 256);
  }
}

/** Per light the visible fractions, NaN where there is no surface, and the picture, 0..255. */
export function draw(method: string, width: number, height: number, lights: Lamp[]): {planes: Float64Array[]; picture: number[][]} {
  const planes = lights.map(() => new Float64Array(width * height).fill(NaN));
  const picture: number[][] = [];
  const eye: V = [0.3, 4, 7.6], forward = unit(sub([0.1, 0.5, 0], eye)), right = unit(cross(forward, [0, 1, 0]));
  const up = cross(right, forward), reach = 0.26;
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const u = (2 * (x + 0.5) / width - 1) * reach * width / height, v = (1 - 2 * (y + 0.5) / height) * reach;
      const direction = unit(along(along(forward, right, u), up, v));
      const hit = meet(eye, direction);
      const light = lights.map((lamp, i) => {
        if (!hit) return 0;
        const cosine = dot(hit.normal, unit(sub(lamp.centre, hit.point)));
        const value = cosine > 0 ? fraction(method, hit.point, hit.ball, lamp) : 0;
        (planes[i] ?? planes[0])?.fill(value, y * width + x, y * width + x + 1);
        return value * Math.max(0, cosine) * lamp.power;
      }).reduce((a, b) => a + b, 0.2);
      picture.push(hit ? hit.colour.map(c => 255 * Math.min(1, c * light) ** (1 / 2.2)) : [170, 196, 224]);
    }
  return {planes, picture};
}
