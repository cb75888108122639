// TransformedShape.CastShape, the nearest hit only.
function make(vertices, indices) {
  const { body, bytes } = build(vertices, indices);
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
  const standing = upright();
  const level = new Jolt.Quat(0, 0, 0, 1);
  function sweep(q, at, answers, to) {
    const upstanding = q[at + 1] > 0;
    const shape = upstanding ? new Jolt.CapsuleShape(q[at + 1], q[at]) : new Jolt.SphereShape(q[at]);
    from.Set(q[at + 2], q[at + 3], q[at + 4]);
    motion.Set(q[at + 5], q[at + 6], q[at + 7]);
    const pose = Jolt.RMat44.prototype.sRotationTranslation(upstanding ? standing : level, from);
    const cast = new Jolt.RShapeCast(shape, one, pose, motion);
    collector.Reset();
    collector.ResetEarlyOutFraction();
    scene.CastShape(cast, settingsOfCast, base, collector, all);
    answers[to] = collector.HadHit() ? collector.mHit.mFraction : 2;
    Jolt.destroy(cast);
    Jolt.destroy(shape);
  }
  return {
    name: engineName(),
    used: 'TransformedShape::CastShape, npm jolt-physics under node',
    bytes,
    sweep,
  };
}

serve(1, (await begin(start, make)).sweep);
