// PhysX: one triangle mesh, cooked with its defaults, both sides of a triangle solid.
let PhysX, memory, physics, scale;

async function start() {
  const folder = modules + 'physx-js-webidl/';
  const factory = (await import(pathToFileURL(folder + 'physx-js-webidl.mjs').href)).default;
  const wasm = await WebAssembly.compile(readFileSync(folder + 'physx-js-webidl.wasm'));
  // It mistakes node for a browser worker unless there is a window and no process, and cannot load itself there.
  const hidden = globalThis.process;
  globalThis.window = globalThis;
  delete globalThis.process;
  try {
    PhysX = await factory({
      // Without memory it would continue, and never end.
      printErr(text) {
        console.error(text);
        if (text.startsWith('Cannot enlarge memory')) throw new Error('this mesh is too large for PhysX in WebAssembly');
      },
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

// The mesh, and the growth of memory.
function cook(vertices, indices) {
  const version = PhysX.PHYSICS_VERSION;
  const foundation = PhysX.CreateFoundation(version, new PhysX.PxDefaultAllocator(), new PhysX.PxDefaultErrorCallback());
  scale = new PhysX.PxTolerancesScale();
  physics = PhysX.CreatePhysics(version, foundation, scale);
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
  return { geometry, bytes: memory.buffer.byteLength - before };
}

function engineName() {
  const version = PhysX.PHYSICS_VERSION;
  return `PhysX ${version >> 24}.${(version >> 16) & 255}.${(version >> 8) & 255}`;
}
