// PxGeometryQuery.sweep.
function make(vertices, indices) {
  const { geometry, bytes } = cook(vertices, indices);
  const origin = new PhysX.PxTransform(PhysX.PxIDENTITYEnum.PxIdentity);
  const pose = new PhysX.PxTransform(PhysX.PxIDENTITYEnum.PxIdentity);
  // A capsule of PhysX lies along x; those of the queries stand along z.
  const upright = new PhysX.PxTransform(new PhysX.PxVec3(0, 0, 0), new PhysX.PxQuat(0, -Math.SQRT1_2, 0, Math.SQRT1_2));
  const direction = new PhysX.PxVec3(1, 0, 0);
  const sphere = new PhysX.PxSphereGeometry(1);
  const capsule = new PhysX.PxCapsuleGeometry(1, 1);
  const hit = new PhysX.PxSweepHit();
  const flags = new PhysX.PxHitFlags(PhysX.PxHitFlagEnum.eMESH_BOTH_SIDES | PhysX.PxHitFlagEnum.eNORMAL);
  function sweep(q, at, answers, to) {
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
    answers[to] = PhysX.PxGeometryQuery.prototype.sweep(direction, length, body, place, geometry, origin, hit, flags)
      ? hit.distance / length : 2;
  }
  return {
    name: `${engineName()} (WASM)`,
    used: 'PxGeometryQuery::sweep, npm physx-js-webidl under node; bytes: what WASM memory grew by',
    bytes,
    sweep,
  };
}

serve(1, (await begin(start, make)).sweep);
