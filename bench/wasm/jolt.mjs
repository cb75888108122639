// Jolt: TransformedShape.CastShape against one MeshShape, both sides of a triangle solid, the nearest hit only.
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

function make(vertices, indices) {
  const settings = new Jolt.JoltSettings();
  settings.mObjectLayerPairFilter = new Jolt.ObjectLayerPairFilterTable(1);
  settings.mBroadPhaseLayerInterface = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(
    settings.mBroadPhaseLayerInterface, 1, settings.mObjectLayerPairFilter, 1);
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
  const scene = body.GetTransformedShape();
  const settingsOfCast = new Jolt.ShapeCastSettings();
  settingsOfCast.mBackFaceModeTriangles = Jolt.EBackFaceMode_CollideWithBackFaces;
  settingsOfCast.mBackFaceModeConvex = Jolt.EBackFaceMode_CollideWithBackFaces;
  settingsOfCast.mReturnDeepestPoint = false;
  const one = new Jolt.Vec3(1, 1, 1);
  const base = new Jolt.RVec3(0, 0, 0);
  const from = new Jolt.RVec3(0, 0, 0);
  const motion = new Jolt.Vec3(0, 0, 0);
  const collector = new Jolt.CastShapeClosestHitCollisionCollector();
  const all = new Jolt.ShapeFilter();
  // A capsule of Jolt stands along y; those of the queries along z.
  const lying = Jolt.Quat.prototype.sRotation(new Jolt.Vec3(1, 0, 0), Math.PI / 2).Clone?.()
    ?? new Jolt.Quat(Math.SQRT1_2, 0, 0, Math.SQRT1_2);
  const level = new Jolt.Quat(0, 0, 0, 1);
  function sweep(q, at, answers, to) {
    const upstanding = q[at + 1] > 0;
    const shape = upstanding ? new Jolt.CapsuleShape(q[at + 1], q[at]) : new Jolt.SphereShape(q[at]);
    from.Set(q[at + 2], q[at + 3], q[at + 4]);
    motion.Set(q[at + 5], q[at + 6], q[at + 7]);
    const pose = Jolt.RMat44.prototype.sRotationTranslation(upstanding ? lying : level, from);
    const cast = new Jolt.RShapeCast(shape, one, pose, motion);
    collector.Reset();
    collector.ResetEarlyOutFraction();
    scene.CastShape(cast, settingsOfCast, base, collector, all);
    answers[to] = collector.HadHit() ? collector.mHit.mFraction : 2;
    Jolt.destroy(cast);
    Jolt.destroy(shape);
  }
  return {
    name: `Jolt (npm ${JSON.parse(readFileSync(modules + 'jolt-physics/package.json')).version}, WASM)`,
    used: 'TransformedShape::CastShape, npm jolt-physics under node',
    bytes,
    sweep,
  };
}

serve(1, (await begin(start, make)).sweep);
