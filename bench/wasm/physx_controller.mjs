// PxCapsuleController: a capsule whose cylinder is at least 2 mm high, the least allowed height.
// Questions: 0, radius, walking (1 or 0), place, height of the cylinder, height of a step; or 1, velocity, seconds.
// Answers: the place.
function make(vertices, indices) {
  const { geometry, bytes } = cook(vertices, indices);
  const settings = new PhysX.PxSceneDesc(scale);
  settings.cpuDispatcher = PhysX.DefaultCpuDispatcherCreate(0);
  settings.filterShader = PhysX.DefaultFilterShader();
  const scene = physics.createScene(settings);
  const material = physics.createMaterial(0, 0, 0);
  const flags = new PhysX.PxShapeFlags(PhysX.PxShapeFlagEnum.eSCENE_QUERY_SHAPE | PhysX.PxShapeFlagEnum.eSIMULATION_SHAPE);
  const shape = physics.createShape(geometry, material, true, flags);
  const walls = physics.createRigidStatic(new PhysX.PxTransform(PhysX.PxIDENTITYEnum.PxIdentity));
  walls.attachShape(shape);
  scene.addActor(walls);
  const manager = PhysX.PxTopLevelFunctions.prototype.CreateControllerManager(scene);
  const filters = new PhysX.PxControllerFilters();
  const gravity = 9.81;
  const way = new PhysX.PxVec3(0, 0, 0);
  let body, walking, falling;
  function place(radius, walks, x, y, z, cylinder, step) {
    if (body) body.release();
    const desc = new PhysX.PxCapsuleControllerDesc();
    desc.radius = radius;
    desc.height = Math.max(0.002, cylinder);
    desc.upDirection = new PhysX.PxVec3(0, 0, 1);
    desc.position = new PhysX.PxExtendedVec3(x, y, z);
    desc.contactOffset = 0.001;
    desc.stepOffset = step;
    desc.slopeLimit = step > 0 ? Math.SQRT1_2 : 0;  // 0: no slope is too steep
    desc.material = material;
    if (!desc.isValid()) throw new Error('PhysX does not take this controller');
    body = manager.createController(desc);
    walking = walks;
    falling = 0;
  }
  function move(q, at, answers, to) {
    if (q[at] === 0) {
      place(q[at + 1], q[at + 2] === 1, q[at + 3], q[at + 4], q[at + 5], q[at + 6], q[at + 7]);
    } else {
      const seconds = q[at + 4];
      if (walking) falling += gravity * seconds;
      way.x = q[at + 1] * seconds;
      way.y = q[at + 2] * seconds;
      way.z = (q[at + 3] - falling) * seconds;
      const touched = body.move(way, 0, seconds, filters);
      if (touched.isSet(PhysX.PxControllerCollisionFlagEnum.eCOLLISION_DOWN)) falling = 0;
    }
    const p = body.getPosition();
    answers[to] = p.x;
    answers[to + 1] = p.y;
    answers[to + 2] = p.z;
  }
  return { name: `${engineName()} controller (WASM)`, used: 'PxController::move', bytes, move };
}

serve(3, (await begin(start, make)).move);
