// A person walks over a floor towards a wall 5 m away. Before that, a ray measures how far the wall is.
//   mcs walk.cs && mono walk.exe        needs libroam.so.0 (Debian: libroam0)
using System;
using System.Runtime.InteropServices;

// The structs of roam.h that this program uses: the same members in the same order. All begin with their size.
[StructLayout(LayoutKind.Sequential)]
struct Vec3 {
  public double X, Y, Z;
  public Vec3(double x, double y, double z) { X = x; Y = y; Z = z; }
}

[StructLayout(LayoutKind.Sequential)]
struct Mesh {
  public UIntPtr Size;
  public IntPtr Name, Vertices;
  public UIntPtr VertexCount;
  public IntPtr VertexStride, Triangles;
  public UIntPtr TriangleCount;
  public IntPtr TriangleStride;
}

[StructLayout(LayoutKind.Sequential)]
struct Impact {
  public UIntPtr Size;
  public double Time, Gap;
  public Vec3 Point, Normal;
  public ulong Triangle;
  public uint Object;
  public byte Hit, Unknown, Feature, Reserved;
}

[StructLayout(LayoutKind.Sequential)]
struct WalkerSettings {
  public UIntPtr Size;
  public double Radius, Height, Eye, Step, SlopeDegrees, SupportRadius, Gravity, JumpHeight, CrouchHeight, ClearanceReach;
}

[StructLayout(LayoutKind.Sequential)]
struct WalkerInput {
  public UIntPtr Size;
  public Vec3 Velocity;
  public double Acceleration, Braking;
  public int Jump, Crouch;
}

[StructLayout(LayoutKind.Sequential)]
struct Step {
  public UIntPtr Size;
  public Vec3 From, To;
  public double Radius, Height, Gap, LeastGap, Length, Elapsed, LandingSpeed;
  public ulong BlockedBy;
  public uint Events;
  public byte Grounded, Blocked, Held, Unknown;
}

static class Roam {
  const string Library = "libroam.so.0";
  public const int Walk = 0;

  [DllImport(Library)] static extern IntPtr roam_error();
  [DllImport(Library)] static extern int roam_world_build(Mesh[] meshes, UIntPtr count, IntPtr options, out IntPtr world);
  [DllImport(Library)] static extern int roam_ray(IntPtr space, Vec3 from, Vec3 motion, ref Impact impact);
  [DllImport(Library)] static extern int roam_walker_person(ref WalkerSettings settings, double radius, double height);
  [DllImport(Library)] static extern int roam_walker_create(IntPtr space, ref WalkerSettings settings, int mode, Vec3 start,
                                                            out IntPtr walker);
  [DllImport(Library)] static extern int roam_walker_step(IntPtr walker, ref WalkerInput input, double dt, ref Step step);
  [DllImport(Library)] public static extern void roam_space_free(IntPtr space);
  [DllImport(Library)] public static extern void roam_walker_free(IntPtr walker);

  static void Check(int status) {
    if (status != 0) throw new Exception(Marshal.PtrToStringAnsi(roam_error()));
  }

  static UIntPtr SizeOf<T>() { return (UIntPtr)Marshal.SizeOf(typeof(T)); }

  public static IntPtr Build(double[] vertices, uint[] triangles) {
    GCHandle v = GCHandle.Alloc(vertices, GCHandleType.Pinned), t = GCHandle.Alloc(triangles, GCHandleType.Pinned);
    try {
      Mesh mesh = new Mesh {
        Size = SizeOf<Mesh>(), Vertices = v.AddrOfPinnedObject(), VertexCount = (UIntPtr)(vertices.Length / 3),
        Triangles = t.AddrOfPinnedObject(), TriangleCount = (UIntPtr)(triangles.Length / 3)
      };
      IntPtr world;
      Check(roam_world_build(new[] { mesh }, (UIntPtr)1, IntPtr.Zero, out world));
      return world;
    } finally {
      v.Free();
      t.Free();
    }
  }

  public static Impact Ray(IntPtr space, Vec3 from, Vec3 motion) {
    Impact impact = new Impact { Size = SizeOf<Impact>() };
    Check(roam_ray(space, from, motion, ref impact));
    return impact;
  }

  public static IntPtr Person(IntPtr space, double radius, double height, Vec3 start) {
    WalkerSettings settings = new WalkerSettings { Size = SizeOf<WalkerSettings>() };
    Check(roam_walker_person(ref settings, radius, height));
    IntPtr walker;
    Check(roam_walker_create(space, ref settings, Walk, start, out walker));
    return walker;
  }

  public static Step Move(IntPtr walker, Vec3 velocity, double dt) {
    WalkerInput input = new WalkerInput { Size = SizeOf<WalkerInput>(), Velocity = velocity };
    Step step = new Step { Size = SizeOf<Step>() };
    Check(roam_walker_step(walker, ref input, dt, ref step));
    return step;
  }
}

static class Program {
  static void Main() {
    double[] vertices = { -9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0, 5, -9, 0, 5, 9, 0, 5, 9, 3, 5, -9, 3 };
    uint[] triangles = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7 };
    IntPtr world = Roam.Build(vertices, triangles);
    Impact wall = Roam.Ray(world, new Vec3(0, 0, 1), new Vec3(10, 0, 0));
    Console.WriteLine(FormattableString.Invariant($"the wall is {10 * wall.Time:F2} m away"));

    IntPtr walker = Roam.Person(world, 0.3, 1.8, new Vec3(0, 0, 1));
    Roam.roam_space_free(world);  // the walker keeps what it needs
    Step step = new Step();
    for (int i = 0; i < 600 && step.Blocked == 0; ++i) step = Roam.Move(walker, new Vec3(1.4, 0, 0), 1.0 / 60);
    Console.WriteLine(FormattableString.Invariant($"stopped at x = {step.To.X:F2} m"));
    Roam.roam_walker_free(walker);
    Environment.ExitCode = step.Blocked != 0 ? 0 : 1;
  }
}
