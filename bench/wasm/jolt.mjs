// Jolt: one MeshShape as a static body, both sides of a triangle solid.
let Jolt;

// The package's module has 128 MB that cannot grow, too little for 0.5 M triangles. This uses the same module with
// more.
function withPages(module, pages) {
  const number = (value) => {
    const bytes = [];
    for (; value > 127; value >>>= 7) bytes.push((value & 127) | 128);
    return [...bytes, value];
  };
  for (let at = 8; at < module.length;) {
    const section = module[at];
    let length = 0, body = at + 1;
    for (let shift = 0; ; shift += 7) {
      const byte = module[body++];
      length |= (byte & 127) << shift;
      if (byte < 128) break;
    }
    if (section === 5) {
      // One memory, with a least and a greatest size.
      const limits = [1, 1, ...number(pages), ...number(pages)];
      return Buffer.concat(
        [module.subarray(0, at), Buffer.from([5, ...number(limits.length), ...limits]), module.subarray(body + length)]);
    }
    at = body + length;
  }
  return module;
}

async function start() {
  const folder = modules + 'jolt-physics/dist/';
  const factory = (await import(pathToFileURL(folder + 'jolt-physics.wasm.js').href)).default;
  const twoGigabytes = 32768;
  const wasm = await WebAssembly.compile(withPages(readFileSync(folder + 'jolt-physics.wasm.wasm'), twoGigabytes));
  Jolt = await factory({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(wasm, imports).then((instance) => done(instance, wasm));
      return {};
    },
  });
}

// The body, its system, and the growth of memory.
function build(vertices, indices) {
  const settings = new Jolt.JoltSettings();
  const pairs = new Jolt.ObjectLayerPairFilterTable(1);
  pairs.EnableCollision(0, 0);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
  const system = new Jolt.JoltInterface(settings);
  const used = () => system.sGetTotalMemory() - system.sGetFreeMemory();
  const before = used();
  const points = new Jolt.VertexList();
  points.resize(vertices.length / 3);
  for (let i = 0; i < vertices.length / 3; ++i) {
    const point = points.at(i);
    point.x = vertices[3 * i];
    point.y = vertices[3 * i + 1];
    point.z = vertices[3 * i + 2];
  }
  const triangles = new Jolt.IndexedTriangleList();
  triangles.resize(indices.length / 3);
  for (let i = 0; i < indices.length / 3; ++i) {
    const triangle = triangles.at(i);
    for (let k = 0; k < 3; ++k) triangle.set_mIdx(k, indices[3 * i + k]);
    triangle.mMaterialIndex = 0;
  }
  const made = new Jolt.MeshShapeSettings(points, triangles, new Jolt.PhysicsMaterialList()).Create();
  if (made.HasError()) throw new Error('Jolt: ' + made.GetError().c_str());
  const mesh = made.Get();
  mesh.AddRef();
  Jolt.destroy(points);
  Jolt.destroy(triangles);
  const bytes = used() - before;
  const creation = new Jolt.BodyCreationSettings(mesh, new Jolt.RVec3(0, 0, 0), new Jolt.Quat(0, 0, 0, 1),
    Jolt.EMotionType_Static, 0);
  const bodies = system.GetPhysicsSystem().GetBodyInterface();
  const body = bodies.CreateBody(creation);
  bodies.AddBody(body.GetID(), Jolt.EActivation_DontActivate);
  return { system, body, bytes };
}

function engineName() {
  return `Jolt (npm ${JSON.parse(readFileSync(modules + 'jolt-physics/package.json')).version}, WASM)`;
}

// A capsule of Jolt stands along y; those of the questions along z.
function upright() {
  return new Jolt.Quat(Math.SQRT1_2, 0, 0, Math.SQRT1_2);
}
