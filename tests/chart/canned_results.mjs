// Writes results as a sweep would: plausible numbers of several methods over three scenes, still and along a path, with
// small pictures.
// Usage: node canned_results.mjs FOLDER [CASES_AT_LEAST]. The same numbers every time.
import {mkdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {deflateSync, crc32 as zlibCrc32} from 'node:zlib';

let seed = 1;
const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
const jitter = amount => 1 + amount * (2 * random() - 1);

// PNG, eight bits RGB. Older versions of node have no crc32.
const table = Uint32Array.from({length: 256}, (_, n) => { for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ n >>> 1 : n >>> 1; return n; });
const crc32 = zlibCrc32 ?? (bytes => { let c = ~0; for (const b of bytes) c = table[(c ^ b) & 255] ^ c >>> 8; return ~c >>> 0; });
const chunk = (type, bytes) => {
  const body = Buffer.concat([Buffer.from(type), bytes]), length = Buffer.alloc(4), sum = Buffer.alloc(4);
  length.writeUInt32BE(bytes.length);
  sum.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, sum]);
};
const png = (width, height, colourOf) => {
  const rows = Buffer.alloc(height * (1 + 3 * width)), head = Buffer.alloc(13);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) rows.set(colourOf(x, y), y * (1 + 3 * width) + 1 + 3 * x);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', head), chunk('IDAT', deflateSync(rows)),
    chunk('IEND', Buffer.alloc(0))]);
};

const METHODS = [
  {name: 'sm', texels: [512, 1024, 2048, 4096], error: 0.06, fixed: 0.55, views: 1, flip: 0},
  {name: 'dv', texels: [512, 1024, 2048, 4096], error: 0.02, fixed: 0.7, views: 1, flip: 0.004},
  {name: 'sdsm-log', texels: [512, 1024, 2048], error: 0.008, fixed: 0.95, views: 4, flip: 0.003},
  {name: 'rtw', texels: [512, 1024, 2048], error: 0.013, fixed: 1.1, views: 1, flip: 0.006},
  {name: 'spsm', texels: [512, 1024], error: 0.0012, fixed: 1.4, views: 1, flip: 0.001},
  {name: 'shadow-volumes', texels: [0], error: 0, fixed: 4.2, views: 0, flip: 0},
  {name: 'ray-traced', texels: [0], error: 0, fixed: 14, views: 0, flip: 0},
];
const SCENES = [
  {name: 'builtin:atrium', views: ['nave', 'gallery'], path: 'walk', lights: ['noon', 'evening'], hard: 1, ms: 21},
  {name: 'builtin:city', views: ['street', 'roofs'], path: 'flight', lights: ['noon', 'evening'], hard: 2.4, ms: 48},
  {name: 'builtin:knot', views: ['front', 'close'], lights: ['side', 'low'], hard: 0.6, ms: 9},
];
const PASSES = {gbuffer: 0.25, analyze: 0.05, plan: 0.02, cull: 0.06, store: 0.4, resolve: 0.04, shade: 0.18};

const [folder, least = '200'] = process.argv.slice(2);
mkdirSync(join(folder, 'images'), {recursive: true});
const keep = (name, bytes) => { writeFileSync(join(folder, 'images', name), bytes); return 'images/' + name; };
const lines = [];
const imagesOf = (id, error) => ({
  picture: keep(`${id}.png`, png(320, 180, (x, y) => { const v = 90 + 60 * Math.sin(x / 23) * Math.cos(y / 17); return [v, v * 0.95, v * 0.8]; })),
  error: keep(`${id}-error.png`, png(320, 180, () => random() < error ? [230, 159, 0] : random() < error ? [86, 180, 233] : [40, 40, 40])),
  plan: keep(`${id}-plan.svg`, `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 720"><rect width="720" height="720" fill="#14171b"/>
<rect x="90" y="${90 + error * 999}" width="500" height="400" fill="none" stroke="#e69f00" stroke-width="3"/></svg>`),
});

for (let round = 0; lines.length < Number(least); ++round)
  for (const scene of SCENES) for (const view of [...scene.views, ...round === 0 && scene.path ? [''] : []])
    for (const light of scene.lights) for (const method of METHODS) for (const texels of method.texels) {
      if (!view && method.name === 'rtw') continue;  // not every method is sent along a path
      const size = [[640, 360], [1280, 720], [320, 180]][round % 3], id = `case-${String(lines.length).padStart(4, '0')}`;
      const line = {case: id, scene: scene.name, view_name: view, view: {vertical_fov_degrees: 60}, light_name: light,
        light: {sun: {direction: {x: 0.3, y: -1, z: 0.2}}}, size, device: 'canned device', driver: 'canned driver 1.0',
        baseline: 'sm,texels=2048', repetitions: 9, method: method.name,
        parameters: texels ? {texels: `${texels}x${texels}`, bias: '2'} : {}};
      if (scene.name === 'builtin:city' && view === 'roofs' && light === 'evening' && method.name === 'shadow-volumes') {
        lines.push({...line, error: {code: 'DEADLINE_EXCEEDED', message: 'the rendering took longer than 900 s; raise --timeout <or> ask for less'}});
        continue;
      }
      const wrong = method.error * scene.hard * (light === 'low' || light === 'evening' ? 1.7 : 1) * jitter(0.25) * (texels ? 512 / texels : 1);
      const ratio = (method.fixed + (texels / 2048) ** 1.4 * 0.45) * jitter(0.06), ms = ratio * scene.ms * size[0] / 640;
      const lit = 0.3 + 0.4 * random(), bytes = texels * texels * 4 * Math.max(method.views, 1);
      const passes = Object.entries(PASSES).filter(([name]) => texels || ['gbuffer', 'shade'].includes(name)).map(([name, share]) => ({
        name, gpu_ms: ms * 0.95 * share * (texels ? 1 : 2.3) * jitter(0.1),
        quartiles: [ms * 0.9 * share, ms * 1.05 * share], work: {fragments: Math.round(1e6 * share * jitter(0.5)), vertices: 262000}}));
      lines.push({...line, frame_ms: ms, frame_quartiles: [ms * 0.96, ms * 1.07], ratio_to_baseline: ratio,
        ratio_quartiles: [ratio * 0.97, ratio * 1.05],
        measures: {pixel_match: 1 - wrong, false_lit: wrong * lit, false_shadow: wrong * (1 - lit), mean_abs_error: wrong * 0.9,
          edge_error_px: {p50: wrong * 60, p95: wrong * 300, max: wrong * 900}, interior_error: wrong * 0.08, texel_px: {p50: wrong * 90, p95: wrong * 210},
          utilisation: texels ? 0.2 + 0.4 * random() : 0, store_bytes: bytes, total_bytes: bytes * 1.1 + (texels ? 65536 : 0), allocated_bytes: bytes * 1.4},
        passes, plan: {views: Array.from({length: method.views}, () => ({width: texels, height: texels}))},
        ...(view ? {} : {motion: {path_name: scene.path, light_path_name: '', frames: 24, points: 2000, seed: 1},
          stability: {flip_rate: method.flip * scene.hard * jitter(0.3), pop: method.flip * 4, texel_jump: method.flip * 50,
            wrong_rate: wrong, points: 2000, pairs: 40000, frames: 24}}),
        images: imagesOf(id, wrong)});
    }
writeFileSync(join(folder, 'results.jsonl'), lines.map(line => JSON.stringify(line) + '\n').join(''));
console.log(`${lines.length} cases`);
