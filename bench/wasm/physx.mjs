// PhysX: PxGeometryQuery.sweep against one triangle mesh, cooked with its defaults, both sides of a triangle solid.
let PhysX, memory;

async function start() {
  const folder = modules + 'physx-js-webidl/';
  const factory = (await import(pathToFileURL(folder + 'physx-js-webidl.mjs').href)).default;
  const wasm = await WebAssembly.compile(readFileSync(folder + 'physx-js-webidl.wasm'));
  // It takes node for a browser worker unless there is a window and no process, and has no way to load itself there.
  const hidden = globalThis.process;
  globalThis.window = globalThis;
  delete globalThis.process;
  try {
    PhysX = await factory({
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(wasm, imports).then((instance) => {
          memory = Object.values(instance.exports).find((e) => e instanceof WebAssembly.Memory)
              ?? Object.values(imports).flatMap(Object.values).find((e) => e instanceof WebAssembly.Memory);
          done(instance, wasm);
        });
        return {};
      },
    });
  } finally {
    globalThis.process = hidden;
  }
}

function make(vertices, indices) {
  const version = PhysX.PHYSICS_VERSION;
  const foundation = PhysX.CreateFoundation(version, new PhysX.PxDefaultAllocator(), new PhysX.PxDefaultErrorCallback());
  const scale = new PhysX.PxTolerancesScale();
  PhysX.CreatePhysics(version, foundation, scale);
  const before = memory.buffer.byteLength;
  const numbers = PhysX._malloc ?? PhysX._webidl_malloc;
  const points = numbers(vertices.byteLength);
  const corners = numbers(indices.byteLength);
  new Float32Array(memory.buffer, points, vertices.length).set(vertices);
  new Uint32Array(memory.buffer, corners, indices.length).set(indices);
  const desc = new PhysX.PxTriangleMeshDesc();
  desc.points.count = vertices.length / 3;
  desc.points.stride = 12;
  desc.points.data = points;
  desc.triangles.count = indices.length / 3;
  desc.triangles.stride = 12;
  desc.triangles.data = corners;
  const mesh = PhysX.CreateTriangleMesh(new PhysX.PxCookingParams(scale), desc);
  if (mesh.ptr === 0) throw new Error('PhysX cannot cook this mesh');
  const geometry = new PhysX.PxTriangleMeshGeometry(mesh);
  geometry.meshFlags.raise(PhysX.PxMeshGeometryFlagEnum.eDOUBLE_SIDED);
  const origin = new PhysX.PxTransform(PhysX.PxIDENTITYEnum.PxIdentity);
  const pose = new PhysX.PxTransform(PhysX.PxIDENTITYEnum.PxIdentity);
  // A capsule of PhysX lies along x; ours stands along z.
  const upright = new PhysX.PxTransform(new PhysX.PxVec3(0, 0, 0), new PhysX.PxQuat(0, -Math.SQRT1_2, 0, Math.SQRT1_2));
  const direction = new PhysX.PxVec3(1, 0, 0);
  const sphere = new PhysX.PxSphereGeometry(1);
  const capsule = new PhysX.PxCapsuleGeometry(1, 1);
  const hit = new PhysX.PxSweepHit();
  const flags = new PhysX.PxHitFlags(PhysX.PxHitFlagEnum.eMESH_BOTH_SIDES | PhysX.PxHitFlagEnum.eNORMAL);
  function sweep(q, at) {
    const x = q[at + 5], y = q[at + 6], z = q[at + 7];
    const length = Math.sqrt(x * x + y * y + z * z);
    direction.x = x / length;
    direction.y = y / length;
    direction.z = z / length;
    const upstanding = q[at + 1] > 0;
    const body = upstanding ? capsule : sphere;
    const place = upstanding ? upright : pose;
    body.radius = q[at];
    if (upstanding) body.halfHeight = q[at + 1];
    const p = place.p;
    p.x = q[at + 2];
    p.y = q[at + 3];
    p.z = q[at + 4];
    return PhysX.PxGeometryQuery.prototype.sweep(direction, length, body, place, geometry, origin, hit, flags)
      ? hit.distance / length : 2;
  }
  const number = `${version >> 24}.${(version >> 16) & 255}.${(version >> 8) & 255}`;
  return {
    name: `PhysX ${number} (WASM)`,
    used: 'PxGeometryQuery::sweep, npm physx-js-webidl under node; bytes: what WASM memory grew by',
    bytes: memory.buffer.byteLength - before,
    sweep,
  };
}

await serve(start, make);
