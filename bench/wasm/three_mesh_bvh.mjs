// three-mesh-bvh: MeshBVH.shapecast with the surface area heuristic, nearest box first, in boxes that the swept body
// may touch before its first touch so far. The triangles go through the closed forms of bench/closed_form.h, in
// doubles. three-mesh-bvh has no capsules: a triangle is extruded by the capsule's axis.
let THREE, BVH;

async function start() {
  const load = async (file) => await import(pathToFileURL(modules + file).href);
  BVH = await load('three-mesh-bvh/src/index.js');
  THREE = await load('three/build/three.module.js');
}

// The sweep at hand: the motion, its square, the body, and the first touch so far; more than 1 if there is none.
let mx, my, mz, mm, radius, rr, first;

function keep(time) {
  if (time >= 0 && time < first) first = time;
}

// The time at which t t a + 2 t b + c falls to zero; -1 if never.
function entry(a, b, c) {
  const square = b * b - a * c;
  return a > 0 && b < 0 && square >= 0 ? c / (Math.sqrt(square) - b) : -1;
}

// Corner a and the edge to b, relative to the start.
function touchEdge(ax, ay, az, bx, by, bz) {
  const ex = bx - ax, ey = by - ay, ez = bz - az, ee = ex * ex + ey * ey + ez * ez;
  const ae = ax * ex + ay * ey + az * ez, aa = ax * ax + ay * ay + az * az;
  const s = ee > 0 ? Math.min(1, Math.max(0, -ae / ee)) : 0;
  const nx = ax + s * ex, ny = ay + s * ey, nz = az + s * ez;
  if (nx * nx + ny * ny + nz * nz <= rr) {
    first = 0;
    return;
  }
  keep(entry(mm, -(mx * ax + my * ay + mz * az), aa - rr));
  const cx = my * ez - mz * ey, cy = mz * ex - mx * ez, cz = mx * ey - my * ex;
  const dx = ay * ez - az * ey, dy = az * ex - ax * ez, dz = ax * ey - ay * ex;
  const time = entry(cx * cx + cy * cy + cz * cz, -(cx * dx + cy * dy + cz * dz),
    dx * dx + dy * dy + dz * dz - rr * ee);
  if (time < 0 || time >= first) return;
  const along = time * (mx * ex + my * ey + mz * ez) - ae;
  if (along >= 0 && along <= ee) first = time;
}

// Whether p is on the inner side of the edge from a to b, seen along the normal n.
function inside(px, py, pz, ax, ay, az, bx, by, bz, nx, ny, nz) {
  const ex = bx - ax, ey = by - ay, ez = bz - az;
  const qx = px - ax, qy = py - ay, qz = pz - az;
  return (ey * qz - ez * qy) * nx + (ez * qx - ex * qz) * ny + (ex * qy - ey * qx) * nz >= 0;
}

// A triangle, relative to the start.
function touch(ax, ay, az, bx, by, bz, cx, cy, cz) {
  const ux = bx - ax, uy = by - ay, uz = bz - az, vx = cx - ax, vy = cy - ay, vz = cz - az;
  const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  const length = Math.sqrt(nx * nx + ny * ny + nz * nz);
  if (length > 0) {
    const height = -(nx * ax + ny * ay + nz * az) / length;
    const side = height >= 0 ? 1 : -1;
    const gap = Math.abs(height) - radius;
    const approach = -side * (nx * mx + ny * my + nz * mz) / length;
    // The plane is farther off than the body comes.
    if (gap > 0 && gap >= Math.min(first, 1) * approach) return;
    const time = gap > 0 ? gap / approach : 0;
    const back = gap > 0 ? side * radius / length : height / length;
    const px = time * mx - back * nx, py = time * my - back * ny, pz = time * mz - back * nz;
    if (inside(px, py, pz, ax, ay, az, bx, by, bz, nx, ny, nz) &&
        inside(px, py, pz, bx, by, bz, cx, cy, cz, nx, ny, nz) &&
        inside(px, py, pz, cx, cy, cz, ax, ay, az, nx, ny, nz)) {
      keep(time);
      return;
    }
  }
  touchEdge(ax, ay, az, bx, by, bz);
  touchEdge(bx, by, bz, cx, cy, cz);
  touchEdge(cx, cy, cz, ax, ay, az);
}

function touchExtruded(ax, ay, az, bx, by, bz, cx, cy, cz, h) {
  touch(ax, ay, az + h, bx, by, bz + h, cx, cy, cz + h);
  touch(ax, ay, az - h, bx, by, bz - h, cx, cy, cz - h);
  touchWall(ax, ay, az, bx, by, bz, h);
  touchWall(bx, by, bz, cx, cy, cz, h);
  touchWall(cx, cy, cz, ax, ay, az, h);
}

function touchWall(ax, ay, az, bx, by, bz, h) {
  touch(ax, ay, az - h, bx, by, bz - h, bx, by, bz + h);
  touch(ax, ay, az - h, bx, by, bz + h, ax, ay, az + h);
}

function make(vertices, indices) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(vertices, 3));
  geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  const bvh = new BVH.MeshBVH(geometry, { strategy: BVH.SAH, targetLeafSize: 4 });
  const corners = geometry.index.array;  // in the order of the leaves now
  const bytes = vertices.byteLength + corners.byteLength + bvh._roots.reduce((sum, root) => sum + root.byteLength, 0);
  let x, y, z, h, ix, iy, iz, reach;

  // The time at which the body's box reaches a box; Infinity if never.
  function arrival(box) {
    const low = box.min, high = box.max;
    let enter = 0, leave = Math.min(first, 1);
    const a = (low.x - x - radius) * ix, b = (high.x - x + radius) * ix;
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
    const c = (low.y - y - radius) * iy, d = (high.y - y + radius) * iy;
    enter = Math.max(enter, Math.min(c, d));
    leave = Math.min(leave, Math.max(c, d));
    const e = (low.z - z - reach) * iz, f = (high.z - z + reach) * iz;
    enter = Math.max(enter, Math.min(e, f));
    leave = Math.min(leave, Math.max(e, f));
    return enter <= leave ? enter : Infinity;
  }
  const callbacks = {
    boundsTraverseOrder: arrival,
    intersectsBounds: (box, isLeaf, score) => score < first,
    intersectsRange(offset, count) {
      for (let i = 3 * offset; i < 3 * (offset + count); i += 3) {
        const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
        const ax = vertices[a] - x, ay = vertices[a + 1] - y, az = vertices[a + 2] - z;
        const bx = vertices[b] - x, by = vertices[b + 1] - y, bz = vertices[b + 2] - z;
        const cx = vertices[c] - x, cy = vertices[c + 1] - y, cz = vertices[c + 2] - z;
        if (h > 0) touchExtruded(ax, ay, az, bx, by, bz, cx, cy, cz, h);
        else touch(ax, ay, az, bx, by, bz, cx, cy, cz);
      }
      return false;
    },
  };
  const farthest = 1e18;  // in place of infinity, whose product with zero is no number
  const inverse = (v) => (Math.abs(v) * farthest > 1 ? 1 / v : farthest);
  function sweep(q, at, answers, to) {
    radius = q[at];
    rr = radius * radius;
    h = q[at + 1];
    reach = radius + h;
    x = q[at + 2];
    y = q[at + 3];
    z = q[at + 4];
    mx = q[at + 5];
    my = q[at + 6];
    mz = q[at + 7];
    mm = mx * mx + my * my + mz * mz;
    ix = inverse(mx);
    iy = inverse(my);
    iz = inverse(mz);
    first = 2;
    bvh.shapecast(callbacks);
    answers[to] = first <= 1 ? first : 2;
  }
  const version = JSON.parse(readFileSync(modules + 'three-mesh-bvh/package.json')).version;
  return {
    name: `three-mesh-bvh ${version}`,
    used: 'MeshBVH.shapecast and closed forms in doubles, JavaScript under node',
    bytes,
    sweep,
  };
}

serve(1, (await begin(start, make)).sweep);
