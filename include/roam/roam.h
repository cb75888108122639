#ifndef ROAM_ROAM_H
#define ROAM_ROAM_H
/** \file
 * The C interface: libroam.so.0, for C99, C++ and every language that calls C functions.
 *
 *     #include <roam/roam.h>
 *     #include <stdio.h>
 *
 *     int main(void) {
 *       roam_space* world = NULL;
 *       if (roam_world_open("house.glb", NULL, &world) != ROAM_OK) return fprintf(stderr, "%s\n", roam_error()), 1;
 *       const roam_query query = {.size = sizeof query, .radius = 0.3, .from = {1, 2, 1.5}, .motion = {9, 0, 0}};
 *       roam_impact impact = {.size = sizeof impact};
 *       if (roam_sweep(world, &query, &impact) == ROAM_OK && impact.hit) printf("stops after %g m\n", 9 * impact.time);
 *       roam_space_free(world);
 *     }
 *
 *     cc program.c $(pkg-config --cflags --libs roam)
 *
 * In CMake: find_package(roam COMPONENTS c) and the target roam::c.
 *
 * Units and axes. Lengths are metres, times seconds, +z is up. Positions are doubles in the scene's own frame. A body
 * is a sphere or an upright capsule: all points within `radius` of a vertical segment of length 2 * half_height about
 * its centre. Radius 0 makes a point. The promises about the results are those of roam/space.h: over [0, time] the body
 * is free, and space that is not loaded counts as solid.
 *
 * Errors. A function that can fail returns a roam_status, and on failure writes no result unless it says so.
 * roam_error() is then a text: what is wrong, where, and what to do. No C++ exception leaves the library.
 *
 * Structs. The first member of most is `size`: set it to sizeof of the struct, and all members that you do not need to
 * 0. Zero is the default of every member, unless a function fills in the defaults. Later versions only append members.
 * The library reads and writes no more than `size` bytes, so a program runs with any later libroam.so.0. Size 0, and a
 * larger size with anything but zeros in the members that this library does not know, give ROAM_INVALID. In an array of
 * such structs all have the size of the first.
 *
 * Handles. A handle is created by a function whose last parameter is its address, and ends by the function _free of its
 * type, which also takes NULL. It keeps alive all that it needs: handles may be freed in any order.
 *
 * Threads. Calls that take a handle as pointer to const may run at the same time in any threads. Calls that take it
 * otherwise need it alone. In a store, roam_space_update(), roam_space_load() and roam_route_follow() change it, all
 * spaces made from it and the walkers in these. roam_filtered_ignore_only() changes its space, all spaces made from
 * that and their walkers. Meanwhile only roam_object_name() and the functions _free may take one of these. The library
 * keeps no global state that a caller can see, but the text of roam_error(), which each thread has. It has threads of
 * its own, so dlclose() does not unload it. A child of fork() lacks them: it must not use or free its parent's stores,
 * nor what was made in them.
 *
 * Callbacks. A roam_progress is called by one thread at a time, not always the caller's, several times a second.
 * It returns 0 to go on, or another number to make the function return ROAM_CANCELLED soon. It must not throw.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define ROAM_API __attribute__((visibility("default")))
#else
#define ROAM_API
#endif

/* ------------------------------------------------------------------------------------------ versions and errors --- */

/** The interface of this header. It grows whenever a function or a member is added. */
#define ROAM_INTERFACE 3

/** The interface of the library that runs. A program needs one that is >= the ROAM_INTERFACE it was compiled with. */
ROAM_API uint32_t roam_interface(void);
/** The version of the library, such as "0.1.0". Static. */
ROAM_API const char* roam_version(void);

typedef int32_t roam_status;
enum {
  ROAM_OK = 0,
  ROAM_INVALID = 1,    /**< an argument: a null pointer, out of range, not finite, of a wrong size */
  ROAM_NOT_FOUND = 2,  /**< there is no such file or folder */
  ROAM_UNREADABLE = 3, /**< a file or folder that is there cannot be read or written, or has no valid contents */
  ROAM_NO_MEMORY = 4,  /**< the machine has too little free memory */
  ROAM_CANCELLED = 5,  /**< by a roam_progress */
  ROAM_FAILED = 6      /**< an error of the system or of this library */
};

/** The text of the last failure in this thread, UTF-8; "" if there was none. Valid until the next failure in it. */
ROAM_API const char* roam_error(void);

/** Receives the fraction done, in [0, 1], and the `progress_data` that was passed with it. See "Callbacks" above. */
typedef int32_t (*roam_progress)(double done, void* data);

typedef struct roam_vec3 {
  double x, y, z;
} roam_vec3;

/* ------------------------------------------------------------------------------------------------------- spaces --- */

/** All that bodies move in: a world in memory, a store on disk, or one of these without some objects. */
typedef struct roam_space roam_space;

#define ROAM_NO_TRIANGLE UINT64_MAX /**< in a miss, or where nothing was found */
#define ROAM_NO_OBJECT UINT32_MAX   /**< in a miss, for unknown space, and for all of a store */

/** The triangles of one object. Strides are in bytes; 0 means packed. The arrays are copied and need no alignment. */
typedef struct roam_mesh {
  size_t size;
  const char* name;       /**< UTF-8, for display; may be NULL */
  const double* vertices; /**< x, y, z of each: finite, at most 1e9, if a triangle has it */
  size_t vertex_count;
  ptrdiff_t vertex_stride;
  const uint32_t* triangles; /**< three indices into vertices each; either winding */
  size_t triangle_count;
  ptrdiff_t triangle_stride;
} roam_mesh;

typedef struct roam_world_options {
  size_t size;
  int32_t threads;  /**< at most one a core; 0: one a core */
  int32_t lossless; /**< 1: a sweep stops up to 0.01 mm before a wall instead of 2 mm, for more memory */
  const char* up;   /**< of a file: "x", "y", "z", "-x", "-y", "-z"; NULL: y for glTF, else z */
  const char* unit; /**< of a file: "m", "cm", "mm", "ft", "in"; NULL: "m" */
  roam_progress progress;
  void* progress_data;
} roam_world_options;

/**
 * Indexes the triangles of meshes in memory. `meshes` may be NULL if `count` is 0: an empty world. Objects are numbered
 * as the meshes, triangles across all of them, in the order passed. `options` may be NULL. ROAM_INVALID: 2^32 triangles
 * or more, an index out of range, a vertex of a triangle that is not finite or beyond 1e9; the text names mesh and
 * triangle.
 */
ROAM_API roam_status roam_world_build(const roam_mesh* meshes, size_t count, const roam_world_options* options,
                                      roam_space** world);
/**
 * Reads a file, or a folder of photogrammetry tiles, and indexes it. docs/importing.md lists the formats. A confined
 * child process, roam-reader, parses the file; it is looked for beside the library and in ../libexec/roam from there.
 */
ROAM_API roam_status roam_world_open(const char* path, const roam_world_options* options, roam_space** world);

typedef struct roam_store_options {
  size_t size;
  uint64_t memory;  /**< bytes, >= 8 MiB, for tiles and all else; 0: 64 MiB */
  int32_t loaders;  /**< loading threads, 1 to 16; 0: 1 for a folder, up to 8 for a web server */
  int32_t reserved; /**< 0 */
  double horizon;   /**< seconds of motion ahead that are loaded; 0: 3 */
  /* Since interface 2; only for a store on a web server, a folder needs none: see roam::WebAccess in roam/store.h. */
  const char* cache;    /**< file for a cache, which processes may share; NULL: none */
  uint64_t cache_bytes; /**< size of that file, >= 4 MiB; 0: 1 GiB */
  double patience;      /**< seconds that a failing request is tried again; 0: 20 */
  int32_t redirects;    /**< not 0: redirects to other hosts and folders are followed */
  int32_t reserved_2;   /**< 0 */
  /* Since interface 3. */
  roam_progress progress; /**< while a web server is waited for; gets 0 */
  void* progress_data;
} roam_store_options;

/**
 * Opens a store, a folder that `roam build` or roam/store_build.h has made, or its address on a web server. Its tiles
 * are loaded around one body: by roam_space_update() while it walks, or by roam_space_load(). Space that is not loaded
 * is solid, and unknown.
 */
ROAM_API roam_status roam_store_open(const char* path, const roam_store_options* options, roam_space** store);

/** `space` without some objects, none at first: a space that shares its triangles. */
ROAM_API roam_status roam_filtered_create(const roam_space* space, roam_space** filtered);
/**
 * Replaces the ignored objects. ROAM_INVALID: `filtered` is not from roam_filtered_create(); objects of a store, whose
 * triangles have no object.
 */
ROAM_API roam_status roam_filtered_ignore_only(roam_space* filtered, const uint32_t* objects, size_t count);

ROAM_API void roam_space_free(roam_space* space);

typedef struct roam_space_facts {
  size_t size;
  roam_vec3 lower, upper; /**< the box of all triangles; lower > upper for an empty world */
  uint64_t triangles;
  uint64_t objects;
  uint64_t bytes;       /**< of memory; of a store: all that it may take */
  double largest_error; /**< largest distance of a stored vertex from the caller's */
  double speed_limit;   /**< m/s: up to this speed a store loads ahead in time; infinite for a world */
  uint64_t failed;      /**< tiles and pages of a store that cannot be read now, and so are solid */
  double ready;         /**< of a store: all within this distance of the body is known */
} roam_space_facts;

ROAM_API roam_status roam_space_get_facts(const roam_space* space, roam_space_facts* facts);

/**
 * The name of the object of a triangle, as snprintf: writes at most `capacity` bytes with the final 0, and returns the
 * length of the whole name. 0: no name, or no memory for it. A thread of a store reads its names. The length is 0
 * until then: call again some milliseconds later. For unknown space the name is the reason: "not loaded yet", or why it
 * cannot be used.
 */
ROAM_API size_t roam_object_name(const roam_space* space, uint64_t triangle, char* name, size_t capacity);

/* ------------------------------------------------------------------------------------------------------ queries --- */

/** A body and its straight motion. */
typedef struct roam_query {
  size_t size;
  roam_vec3 from;          /**< the centre at time 0; finite */
  roam_vec3 motion;        /**< the centre at time 1 minus `from`; each component at most 1e6 */
  double radius;           /**< [0, 1000] */
  double half_height;      /**< [0, 1000]; 0: a sphere */
  const uint32_t* ignored; /**< numbers of objects to ignore, ascending; none of a store */
  size_t ignored_count;
} roam_query;

enum { ROAM_FACE = 0, ROAM_EDGE = 1, ROAM_VERTEX = 2 };

/** The first impact of a motion. A miss has time 1, and 0 or no number in the rest. */
typedef struct roam_impact {
  size_t size;
  double time;      /**< fraction of the motion that is certified free, in [0, 1]; 0: starts in touch, or within 2 mm */
  double gap;       /**< certified lower bound at `time`; negative: the body starts that deep in the triangle */
  roam_vec3 point;  /**< on the triangle */
  roam_vec3 normal; /**< unit vector from `point` towards the body's axis */
  uint64_t triangle; /**< of a world as roam_world_build() counts; of a store only for roam_object_name() */
  uint32_t object;
  uint8_t hit;     /**< 0 or 1, as `unknown` */
  uint8_t unknown; /**< the hit is the border of space that is not loaded */
  uint8_t feature; /**< ROAM_FACE, ROAM_EDGE or ROAM_VERTEX */
  uint8_t reserved;
} roam_impact;

/** A triangle near a body. */
typedef struct roam_contact {
  size_t size;
  double gap; /**< certified lower bound of the distance from the body's surface; <= 0: touches or overlaps */
  roam_vec3 point;
  roam_vec3 normal;
  uint64_t triangle; /**< as in roam_impact */
  uint32_t object;
  uint8_t found; /**< 0: nothing within the reach; `gap` is the reach then */
  uint8_t unknown;
  uint8_t feature;
  uint8_t reserved;
} roam_contact;

/** The first impact of the body on its motion. */
ROAM_API roam_status roam_sweep(const roam_space* space, const roam_query* query, roam_impact* impact);
/** The first triangle on the segment from `from` to `from + motion`: the sweep of a point. */
ROAM_API roam_status roam_ray(const roam_space* space, roam_vec3 from, roam_vec3 motion, roam_impact* impact);
/** The least gap over the motion, within `reach` of the body's surface; reach in [0, 1000]. */
ROAM_API roam_status roam_clearance(const roam_space* space, const roam_query* query, double reach,
                                    roam_contact* nearest);
/**
 * The triangles within `reach` of the body's surface, each where the motion brings the body closest, nearest first.
 * Writes at most `capacity` of them and their number. Fewer than `capacity` means all. contacts[0].size must be set.
 */
ROAM_API roam_status roam_contacts(const roam_space* space, const roam_query* query, double reach,
                                   roam_contact* contacts, size_t capacity, size_t* count);
/** Whether the body is free where the motion begins: 0 or 1. A true gap above 2 mm suffices. */
ROAM_API roam_status roam_fits(const roam_space* space, const roam_query* query, int32_t* fits);

/* ------------------------------------------------------------------------------------------------------ batches --- */

/** Numbers of each query: those of query i begin at data + i * stride bytes. Stride 0: the same for all. */
typedef struct roam_input {
  const void* data;
  ptrdiff_t stride;
} roam_input;

/** Room for the results of each query: those of query i go to data + i * stride bytes. Data NULL: not wanted. */
typedef struct roam_output {
  void* data;
  ptrdiff_t stride;
} roam_output;

/**
 * Queries in arrays of any layout: one array a member, or one of your structs. Nothing needs alignment. Each query has
 * one result of the type beside each output, or `most` of them, one after another, in roam_contacts_batch().
 */
typedef struct roam_batch {
  size_t size;
  size_t count;            /**< of queries */
  roam_input from;         /**< 3 double each */
  roam_input motion;       /**< 3 double each; data NULL: all at rest */
  roam_input radius;       /**< 1 double each; data NULL: 0 */
  roam_input half_height;  /**< 1 double each; data NULL: 0 */
  const uint32_t* ignored; /**< objects that all queries ignore, ascending; none of a store */
  size_t ignored_count;
  double reach;         /**< of clearance and contacts, [0, 1000] */
  size_t most;          /**< of contacts: results a query, >= 1 */
  roam_output hit;      /**< uint8_t: roam_impact::hit, roam_contact::found, whether it fits */
  roam_output time;     /**< double; of a sweep */
  roam_output gap;      /**< double */
  roam_output point;    /**< 3 double */
  roam_output normal;   /**< 3 double */
  roam_output triangle; /**< uint64_t */
  roam_output object;   /**< uint32_t */
  roam_output feature;  /**< uint8_t */
  roam_output unknown;  /**< uint8_t */
  roam_output found;    /**< size_t, one a query: how many contacts; the rest of its results is as if not found */
  roam_progress progress;
  void* progress_data;
} roam_batch;

/*
 * The functions above for all queries, on all cores. Results are, to the bit, those of single queries. A query with an
 * error is named by its number; after an error or a cancellation the outputs have unspecified values. A sweep without
 * the outputs gap, point, normal and feature is faster. For a body that does not fit, the other outputs say what is in
 * the way.
 */
ROAM_API roam_status roam_sweep_batch(const roam_space* space, const roam_batch* batch);
ROAM_API roam_status roam_clearance_batch(const roam_space* space, const roam_batch* batch);
ROAM_API roam_status roam_contacts_batch(const roam_space* space, const roam_batch* batch);
ROAM_API roam_status roam_fits_batch(const roam_space* space, const roam_batch* batch);

/* ------------------------------------------------------------------------------------------------------ walkers --- */

/** A body that walks or flies and never passes through a wall. roam/walker.h and docs/walking.md have its rules. */
typedef struct roam_walker roam_walker;

enum { ROAM_WALK = 0, ROAM_FLY = 1, ROAM_GHOST = 2 };

/** The body and what it can do. roam_walker_person() fills in an adult. Ranges: roam/walker_settings.h. */
typedef struct roam_walker_settings {
  size_t size;
  double radius;         /**< >= 0.001 */
  double height;         /**< >= 2 * radius; equal: a sphere */
  double eye;            /**< height of the camera above the lowest point */
  double step;           /**< height of the steps that it walks up and down */
  double slope_degrees;  /**< [0, 89]: steeper ground is a wall to go up */
  double support_radius; /**< of the disc that carries it over cracks of the floor; 0: none */
  double gravity;        /**< m/s2 */
  double jump_height;
  double crouch_height;
  double clearance_reach; /**< caps the reported gaps */
} roam_walker_settings;

/** Fills in an adult of that radius and height; `settings->size` must be set. height 2 * radius: a sphere. */
ROAM_API roam_status roam_walker_person(roam_walker_settings* settings, double radius, double height);

/** The wish for one step. */
typedef struct roam_walker_input {
  size_t size;
  roam_vec3 velocity;  /**< m/s; on foot only the horizontal part counts */
  double acceleration; /**< m/s2; 0: no limit */
  double braking;      /**< m/s2; 0: no limit */
  int32_t jump;
  int32_t crouch;
} roam_walker_input;

/** Bits of roam_step::events: 1 << one of these. roam/step_report.h explains each. */
enum {
  ROAM_SLID,
  ROAM_BLOCKED,
  ROAM_STEPPED_UP,
  ROAM_STEPPED_DOWN,
  ROAM_JUMPED,
  ROAM_AIRBORNE,
  ROAM_LANDED,
  ROAM_FELL,
  ROAM_CROUCHED,
  ROAM_STOOD,
  ROAM_PLACED,
  ROAM_FREED,
  ROAM_HELD,
  ROAM_PUT_BACK,
  ROAM_RETURNED,
  ROAM_THROTTLED,
  ROAM_MET_UNKNOWN,
  ROAM_SLOWED,
  ROAM_NARROWED,
  ROAM_WIDENED,
  ROAM_BRIDGED
};

/** The result of a step, or of another call that moves a walker. */
typedef struct roam_step {
  size_t size;
  roam_vec3 from, to;    /**< the centre before and after */
  double radius, height; /**< of the body now */
  double gap;            /**< certified, at `to`; negative or 0: none, as of a ghost, or of a body that overlaps */
  double least_gap;      /**< certified, over the whole move */
  double length;         /**< of the way, without being put elsewhere */
  double elapsed;        /**< simulated time: dt, or a part of it if the step was too complex */
  double landing_speed;  /**< m/s; 0: no landing */
  uint64_t blocked_by;   /**< the triangle that stops it, if `blocked`; else ROAM_NO_TRIANGLE */
  uint32_t events;       /**< bits, see above */
  uint8_t grounded, blocked, held, unknown;
} roam_step;

/** A walker as it is between two calls. */
typedef struct roam_walker_state {
  size_t size;
  roam_vec3 position; /**< of the centre */
  roam_vec3 feet;     /**< the lowest point */
  roam_vec3 eye;      /**< the camera */
  roam_vec3 velocity; /**< m/s, over the last call */
  double radius, height;
  double rise_speed; /**< m/s, in the air */
  double skin;       /**< the gap that it keeps from surfaces along which it slides */
  int32_t mode;      /**< ROAM_WALK, ROAM_FLY or ROAM_GHOST */
  uint8_t grounded, crouched, held, reserved;
} roam_walker_state;

/**
 * Puts a body with its centre at `start`. If it does not fit there, it is freed to the nearest free position at most
 * its height away, or held: see roam_walker_state::held. In a store, load the surroundings first: roam_space_load().
 */
ROAM_API roam_status roam_walker_create(const roam_space* space, const roam_walker_settings* settings, int32_t mode,
                                        roam_vec3 start, roam_walker** walker);
/** A second body in the same state, such as a snapshot to return to. */
ROAM_API roam_status roam_walker_copy(const roam_walker* walker, roam_walker** copy);
ROAM_API void roam_walker_free(roam_walker* walker);

/* `step` may be NULL in all of these. */

/** Moves the body for `dt` seconds, >= 0. */
ROAM_API roam_status roam_walker_step(roam_walker* walker, const roam_walker_input* input, double dt, roam_step* step);
/** Puts it with its centre there, at rest, as roam_walker_create(). */
ROAM_API roam_status roam_walker_place(roam_walker* walker, roam_vec3 centre, roam_step* step);
ROAM_API roam_status roam_walker_place_feet(roam_walker* walker, roam_vec3 feet, roam_step* step);
ROAM_API roam_status roam_walker_set_mode(roam_walker* walker, int32_t mode, roam_step* step);
ROAM_API roam_status roam_walker_get_state(const roam_walker* walker, roam_walker_state* state);
ROAM_API roam_status roam_walker_get_settings(const roam_walker* walker, roam_walker_settings* settings);
/**
 * The contacts of the last call, each once, in the order in which they were last touched: the last one stops a blocked
 * body. If there are more than 8: the first 7 and the last. `gap` is to the plane of the contact where the body
 * stopped.
 */
ROAM_API roam_status roam_walker_get_contacts(const roam_walker* walker, roam_contact* contacts, size_t capacity,
                                              size_t* count);

/**
 * Takes loaded tiles of a store into use, and loads ahead of the walker: call it between two steps. `changed` may be
 * NULL. Does nothing in a world.
 */
ROAM_API roam_status roam_space_update(roam_space* space, const roam_walker* walker, int32_t* changed);
/**
 * Loads the surroundings of a body and of its motion from a store: 4 m around the body, or the motion's length if that
 * is more. Ends after `seconds`, or when memory holds no more. Before roam_clearance() and roam_contacts() add their
 * reach to the radius. Writes whether all of it is known or known to be unreadable: 1 or 0. 0 for a motion longer than
 * 1000 m, of which it loads no more. Always 1 in a world.
 */
ROAM_API roam_status roam_space_load(roam_space* space, const roam_query* query, double seconds, roam_progress progress,
                                     void* progress_data, int32_t* complete);

/* ------------------------------------------------------------------------------------------------------- routes --- */

typedef struct roam_route_options {
  size_t size;
  double speed;           /**< m/s; 0: 1.4 */
  double dt;              /**< of one step; 0: 1/60 */
  double patience;        /**< time without progress after which the body is blocked; 0: 1 */
  double wait;            /**< real time to wait for a store after its last change; 0: 10 */
  roam_progress progress; /**< gets the fraction of the waypoints reached; in a store 0 */
  void* progress_data;
} roam_route_options;

enum { ROAM_ROUTE_REACHED, ROAM_ROUTE_BLOCKED, ROAM_ROUTE_LEFT_SCENE, ROAM_ROUTE_FELL, ROAM_ROUTE_HELD };

typedef struct roam_route_result {
  size_t size;
  int32_t outcome; /**< ROAM_ROUTE_REACHED, ... */
  int32_t reserved;
  uint64_t waypoints; /**< reached, with the start */
  uint64_t steps;
  double length;        /**< of the way */
  double simulated;     /**< time */
  double least_gap;     /**< certified, over all of it */
  roam_vec3 end;        /**< the centre */
  uint64_t blocked_by;  /**< the triangle, or ROAM_NO_TRIANGLE */
  roam_vec3 blocked_at; /**< on it */
  double opening;       /**< width of the opening that is too small; 0: a closed wall, or not blocked */
} roam_route_result;

/** Puts the walker at the first waypoint and heads for each in turn; they are positions of its centre. */
ROAM_API roam_status roam_route_follow(roam_walker* walker, const roam_vec3* waypoints, size_t count,
                                       const roam_route_options* options, roam_route_result* result);

/* ----------------------------------------------------------------------------------- probes, training, profiles --- */

/** A scene with all that probes and training need: a lossless world, its floors, and the triangles. */
typedef struct roam_survey roam_survey;
/** A profile: the sizes of a body that suit a scene. docs/profile.md describes its file. */
typedef struct roam_profile roam_profile;
/** A list of positions. */
typedef struct roam_path roam_path;

/** As roam_world_build() and roam_world_open(). A slope of 45 degrees divides floor from walls. */
ROAM_API roam_status roam_survey_build(const roam_mesh* meshes, size_t count, const roam_world_options* options,
                                       roam_survey** survey);
ROAM_API roam_status roam_survey_open(const char* path, const roam_world_options* options, roam_survey** survey);
ROAM_API void roam_survey_free(roam_survey* survey);

typedef struct roam_probe_options {
  size_t size;
  roam_vec3 from, to;     /**< of the feet or eyes, which drop to the floor; flying: of the centre */
  double radius;          /**< >= 0.001 */
  double height;          /**< >= 2 * radius; 0: a sphere. A flying body is a sphere */
  int32_t mode;           /**< ROAM_WALK or ROAM_FLY */
  int32_t reserved;       /**< 0 */
  double step;            /**< height of steps that it climbs; 0: 0.3, negative: none */
  double spacing;         /**< of the search; 0: 0.2. Openings narrower than 0.7 * spacing may be overlooked */
  roam_progress progress; /**< gets 0: how long a search takes is not known */
  void* progress_data;
} roam_probe_options;

enum {
  ROAM_LIMIT_NONE,
  ROAM_LIMIT_DOOR,
  ROAM_LIMIT_LINTEL,
  ROAM_LIMIT_GAP,
  ROAM_LIMIT_EDGE,
  ROAM_LIMIT_START,
  ROAM_LIMIT_TARGET,
  ROAM_LIMIT_HEIGHT,
  ROAM_LIMIT_STEP,
  ROAM_LIMIT_APART
};

typedef struct roam_probe_answer {
  size_t size;
  uint8_t passable;          /**< a way is wide enough, and a walker has gone it */
  uint8_t wide_enough;       /**< a way is wide enough */
  uint8_t proven;            /**< certified: see roam/probe.h */
  uint8_t found;             /**< there is a way for some radius */
  int32_t limit;             /**< kind of the limit of the way: ROAM_LIMIT_DOOR, ... */
  double widest_radius;      /**< the largest that passes; infinite if nothing limits it */
  double length;             /**< of the way */
  roam_vec3 limit_point;     /**< the middle of the measured distance */
  roam_vec3 limit_direction; /**< unit, along it */
  double limit_size;         /**< of the limit: a width, a headroom, the height of a step */
  double limit_needed;       /**< by the body */
} roam_probe_answer;

/** Whether a body gets from one position to another, and its obstacle. `way` may be NULL; else the centre's way. */
ROAM_API roam_status roam_probe(const roam_survey* survey, const roam_probe_options* options, roam_probe_answer* answer,
                                roam_path** way);
/** The positions of a path and their number. Valid as long as the path. */
ROAM_API const roam_vec3* roam_path_points(const roam_path* path, size_t* count);
ROAM_API void roam_path_free(roam_path* path);

typedef struct roam_train_options {
  size_t size;
  int32_t mode;      /**< ROAM_WALK or ROAM_FLY */
  int32_t paths;     /**< 0: 5, or more if there are more rooms */
  uint64_t seed;     /**< of the paths; 0: 1 */
  double height;     /**< of a walking body; 0: a sphere */
  double radius_min; /**< narrower openings are ignored; 0: 0.15 */
  double radius_max; /**< 0: 1 */
  double spacing;    /**< as in a probe; 0: 0.2 */
  int32_t threads;   /**< 0: one a core */
  int32_t reserved;  /**< 0 */
  roam_progress progress;
  void* progress_data;
} roam_train_options;

typedef struct roam_training {
  size_t size;
  double radius, height, support_radius, step, slope_degrees; /**< the body to use */
  double smallest; /**< half the width of the widest crack: lower end of the radii that serve; 0: no crack */
  double largest;  /**< upper end: decided by the narrowest opening; infinite: none */
  uint64_t paths;  /**< planned and walked */
  uint64_t cracks;
  uint64_t places;  /**< free positions searched; 0: no body fits anywhere, and the rest says nothing */
  uint8_t feasible; /**< one body without a support disc serves all paths */
  uint8_t complete; /**< 0: ended early */
  uint8_t reserved[6];
} roam_training;

/** Finds the sizes of a body that pass everywhere and fall nowhere. `profile` may be NULL. */
ROAM_API roam_status roam_train(const roam_survey* survey, const roam_train_options* options, roam_training* training,
                                roam_profile** profile);

/** Reads a profile, or the profile beside a scene: "dam.ply" has "dam.ply.roam.json". It must be of a valid form. */
ROAM_API roam_status roam_profile_load(const char* file, roam_profile** profile);
ROAM_API roam_status roam_profile_beside(const char* scene, roam_profile** profile);
/**
 * Writes it; a reader of the file sees the old or the new one, never a part. It replaces only a profile; a link that
 * has the name is replaced, not followed.
 */
ROAM_API roam_status roam_profile_save(const roam_profile* profile, const char* file);
/** Sets radius, height, step, slope, support radius and eye of `settings`, which must have been filled in. */
ROAM_API roam_status roam_profile_apply(const roam_profile* profile, roam_walker_settings* settings);
/** Gives the walker the profile's regions, in which it has another size. */
ROAM_API roam_status roam_walker_set_regions(roam_walker* walker, const roam_profile* profile);
ROAM_API void roam_profile_free(roam_profile* profile);

#ifdef __cplusplus
}
#endif
#endif
