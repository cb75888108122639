// CharacterVirtual. Questions and answers as in physx_controller.mjs.
function make(vertices, indices) {
  const { system, bytes } = build(vertices, indices);
  const physics = system.GetPhysicsSystem();
  const everything = [
    new Jolt.DefaultBroadPhaseLayerFilter(system.GetObjectVsBroadPhaseLayerFilter(), 0),
    new Jolt.DefaultObjectLayerFilter(system.GetObjectLayerPairFilter(), 0),
    new Jolt.BodyFilter(), new Jolt.ShapeFilter(), system.GetTempAllocator()];
  const gravity = 9.81;
  const weight = new Jolt.Vec3(0, 0, -gravity), none = new Jolt.Vec3(0, 0, 0);
  const velocity = new Jolt.Vec3(0, 0, 0);
  const how = new Jolt.ExtendedUpdateSettings();
  let body, walking, falling;
  function place(radius, walks, x, y, z, cylinder, step) {
    if (body) Jolt.destroy(body);
    const shape = cylinder > 0
      ? new Jolt.CapsuleShapeSettings(0.5 * cylinder, radius) : new Jolt.SphereShapeSettings(radius);
    const settings = new Jolt.CharacterVirtualSettings();
    settings.mUp = new Jolt.Vec3(0, 0, 1);
    settings.mSupportingVolume = new Jolt.Plane(settings.mUp, 0.5 * cylinder);  // contacts of the lower half ball
    settings.mMaxSlopeAngle = Math.PI / 4;
    settings.mShape = new Jolt.RotatedTranslatedShapeSettings(none, upright(), shape).Create().Get();
    body = new Jolt.CharacterVirtual(settings, new Jolt.RVec3(x, y, z), new Jolt.Quat(0, 0, 0, 1), physics);
    how.mStickToFloorStepDown = new Jolt.Vec3(0, 0, -step);
    how.mWalkStairsStepUp = new Jolt.Vec3(0, 0, step);
    walking = walks;
    falling = 0;
  }
  function move(q, at, answers, to) {
    if (q[at] === 0) {
      place(q[at + 1], q[at + 2] === 1, q[at + 3], q[at + 4], q[at + 5], q[at + 6], q[at + 7]);
    } else {
      const seconds = q[at + 4];
      if (walking) falling = body.GetGroundState() === Jolt.EGroundState_OnGround ? 0 : falling + gravity * seconds;
      velocity.Set(q[at + 1], q[at + 2], q[at + 3] - falling);
      body.SetLinearVelocity(velocity);
      if (walking) body.ExtendedUpdate(seconds, weight, how, ...everything);
      else body.Update(seconds, none, ...everything);
    }
    const p = body.GetPosition();
    answers[to] = p.GetX();
    answers[to + 1] = p.GetY();
    answers[to + 2] = p.GetZ();
  }
  return { name: engineName(), used: 'CharacterVirtual', bytes, move };
}

serve(3, (await begin(start, make)).move);
