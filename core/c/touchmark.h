/// The detectors of Touchmark for C, and so for every language that calls C.
///
/// Handles are opaque: one that a create or build function returned is freed by its free function, which
/// also takes NULL. Where something is wrong, a function that makes a handle returns NULL and any other
/// returns TOUCHMARK_ERROR, and touchmark_last_error() says what in one line. Nothing is thrown. Lengths are
/// in the mesh's own units. docs/c.md has an example.
#ifndef TOUCHMARK_TOUCHMARK_H
#define TOUCHMARK_TOUCHMARK_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(TOUCHMARK_BUILDS_C)
#define TOUCHMARK_API __declspec(dllexport)
#elif defined(_WIN32)
#define TOUCHMARK_API __declspec(dllimport)
#else
#define TOUCHMARK_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Triangles in double precision, checked. Constant once made.
typedef struct touchmark_mesh touchmark_mesh;
/// A search structure over a mesh, of which it keeps a copy. Constant but for touchmark_detector_update.
typedef struct touchmark_detector touchmark_detector;
/// What one haptic point remembers between ticks. It keeps its detector alive. Only one thread may use a
/// session at a time; many threads may ask one detector with a session each.
typedef struct touchmark_session touchmark_session;

/// A haptic proxy: a ball, or a point, that follows the device's tip and never crosses the surface. It keeps
/// its detector alive. Only one thread may use a proxy at a time.
typedef struct touchmark_proxy touchmark_proxy;

/// Bodies in poses, asked as one: each a shape, which any number of bodies may share. Nobody may change it
/// while a query runs.
typedef struct touchmark_scene touchmark_scene;
/// What one haptic point remembers of a scene between ticks, as a touchmark_session. It keeps its scene
/// alive.
typedef struct touchmark_scene_session touchmark_scene_session;

/// What queries return: found or touching, not so, or an error.
enum { TOUCHMARK_YES = 1, TOUCHMARK_NO = 0, TOUCHMARK_ERROR = -1 };

/// The side of the surface that a probe's centre is on. It is asked for when the detector is built, by
/// "side=on". Inside is behind the faces, whose corners run counter-clockwise seen from outside.
enum {
  TOUCHMARK_SIDE_UNASKED = 0,
  TOUCHMARK_SIDE_OUTSIDE = 1,
  TOUCHMARK_SIDE_INSIDE = 2,
  TOUCHMARK_SIDE_ON_SURFACE = 3,
  TOUCHMARK_SIDE_UNDECIDED = 4 /**< the mesh does not say */
};

/// The point of a mesh, or of a scene's bodies, nearest to a probe's centre.
typedef struct touchmark_contact {
  double point[3];   ///< on the surface
  double normal[3];  ///< unit, from the point towards the centre; the face normal where they coincide
  double distance;   ///< from the centre to the point, 0 or more
  uint32_t triangle; /**< its place among its mesh's triangles, from 0; the lowest of those equally near */
  int32_t side;      ///< one of TOUCHMARK_SIDE_...
} touchmark_contact;

/// The first touch of a ball on a straight way.
typedef struct touchmark_impact {
  double fraction;           /**< 0 to 1, rounded down; 0 where and only where it touches at the start */
  touchmark_contact contact; /**< that of the ball standing there */
} touchmark_impact;

/// How a device's tip, the goal, is coupled to its proxy. Lengths are in mesh units. Zero turns a part off.
typedef struct touchmark_coupling {
  double radius;           ///< the ball's; 0: the bare point
  double stiffness;        ///< N a mesh unit, of the spring between proxy and goal
  double static_friction;  ///< coefficient, of Coulomb's friction at rest
  double dynamic_friction; /**< coefficient, in motion; at most the static one */
  double damping;          ///< N s a mesh unit, against the goal's velocity while in contact
  double tick_s;           ///< seconds a tick of the servo loop, more than 0
  uint64_t max_work;       /**< bounds what a step looks at, in boxes and triangles; docs/proxy.md */
} touchmark_coupling;

/// How a proxy is.
enum {
  TOUCHMARK_PROXY_FREE = 0,       ///< nothing holds it: it is at its goal
  TOUCHMARK_PROXY_IN_CONTACT = 1, /**< the surface holds it */
  TOUCHMARK_PROXY_STUCK = 2,      /**< it was put too near to the surface, and is not off yet */
  TOUCHMARK_PROXY_UNANSWERED = 3  /**< the goal is no number; the proxy stays */
};

/// Flags of a step.
enum { TOUCHMARK_PROXY_UNFINISHED = 1 /**< it ended at max_work, at a place that is as sure as any */ };

/// What one tick of a proxy came to.
typedef struct touchmark_proxy_state {
  double position[3];    ///< the proxy's
  double force[3];       ///< N, on the device
  double normals[3][3];  ///< unit, out of the surface, a plane that holds it each
  int32_t status;        ///< one of TOUCHMARK_PROXY_...
  uint32_t contacts;     ///< how many planes hold it, 3 at most: so many of `normals` are set
  uint64_t flags;        /**< TOUCHMARK_PROXY_UNFINISHED, or 0 */
} touchmark_proxy_state;

/// The planes that hold a proxy, for the force on a device that is faster than the proxy's loop. A program
/// may copy it from one thread to another; what its numbers are may change from version to version.
typedef struct touchmark_force_planes {
  double numbers[22];
} touchmark_force_planes;

/// Returns "MAJOR.MINOR.PATCH" of the library that is linked.
TOUCHMARK_API const char* touchmark_version(void);

/// Returns why the last function that failed on this thread did, in one line; "" if none has. Valid until
/// another one fails on this thread.
TOUCHMARK_API const char* touchmark_last_error(void);

/// Makes a mesh of `vertex_count` points, three coordinates each, and `triangle_count` triangles, three
/// numbers of points each, from 0. Both arrays are copied. Fails for no triangle, a number that names no
/// point, or a coordinate that is not finite.
TOUCHMARK_API touchmark_mesh* touchmark_mesh_create(const double* vertices, size_t vertex_count,
                                                    const uint32_t* triangles, size_t triangle_count);
/// Frees a mesh. Detectors built of it stay as they are.
TOUCHMARK_API void touchmark_mesh_free(touchmark_mesh* mesh);
/// Stores the box of the vertices that triangles use. Returns TOUCHMARK_YES or TOUCHMARK_ERROR.
TOUCHMARK_API int touchmark_mesh_bounds(const touchmark_mesh* mesh, double min[3], double max[3]);

/// Builds a detector. `text` names it and its options as on the command line: "sphere-cluster",
/// "grid-group:cell=1%,side=on"; NULL stands for "sphere-cluster". docs/c.md lists the options.
TOUCHMARK_API touchmark_detector* touchmark_detector_build(const touchmark_mesh* mesh, const char* text);
/// Frees a detector, once the last of its sessions is freed.
TOUCHMARK_API void touchmark_detector_free(touchmark_detector* detector);
/// Returns the memory that it takes, in bytes; 0 for NULL.
TOUCHMARK_API size_t touchmark_detector_bytes(const touchmark_detector* detector);
/// Takes a mesh of the same triangles with vertices elsewhere; sessions go on. No query may run meanwhile.
/// Returns TOUCHMARK_YES or TOUCHMARK_ERROR. It is as it was where the triangles are others; after any other
/// error it answers no more.
TOUCHMARK_API int touchmark_detector_update(touchmark_detector* detector, const touchmark_mesh* mesh);

/// Begins a session. Takes memory; queries do not.
TOUCHMARK_API touchmark_session* touchmark_session_create(const touchmark_detector* detector);
/// Frees a session.
TOUCHMARK_API void touchmark_session_free(touchmark_session* session);

/// Is the distance from the centre to the mesh at most the radius? A centre that is not finite touches
/// nothing.
TOUCHMARK_API int touchmark_touches(touchmark_session* session, const double center[3], double radius);
/// Stores the contact of the nearest triangle, if it is within `reach`, which may be infinite. `contact` is
/// left as it was otherwise, and may be NULL.
TOUCHMARK_API int touchmark_nearest(touchmark_session* session, const double center[3], double reach,
                                    touchmark_contact* contact);
/// Stores the first touch of a ball that moves straight from one point to the other, if there is one.
/// `impact` is left as it was otherwise, and may be NULL.
TOUCHMARK_API int touchmark_first_hit(touchmark_session* session, const double from[3], const double to[3],
                                      double radius, touchmark_impact* impact);
/// Stores a contact for each triangle within `reach`, nearest first, as many as fit into `capacity` of them,
/// and in `count` how many there are, which may be more. `contacts` may be NULL where the capacity is 0.
/// Takes memory where the capacity is larger than at any call of this session before.
TOUCHMARK_API int touchmark_contacts(touchmark_session* session, const double center[3], double reach,
                                     touchmark_contact* contacts, size_t capacity, size_t* count);
/// Does ahead what the next query would do first: best right after waking, before the device is read. It
/// changes no answer. Returns TOUCHMARK_YES or TOUCHMARK_ERROR.
TOUCHMARK_API int touchmark_prepare(touchmark_session* session);

/// Stores what a coupling is where nothing else is said: a bare point, 1000 N a mesh unit, no friction, no
/// damping, 1 ms a tick. Returns TOUCHMARK_YES or TOUCHMARK_ERROR.
TOUCHMARK_API int touchmark_coupling_default(touchmark_coupling* coupling);
/// Makes a proxy that has yet to be placed. The detector must decide exactly, as all do but those with
/// "certified=false" or "precise=false". `coupling` may be NULL for the default one.
TOUCHMARK_API touchmark_proxy* touchmark_proxy_create(const touchmark_detector* detector,
                                                      const touchmark_coupling* coupling);
/// Frees a proxy.
TOUCHMARK_API void touchmark_proxy_free(touchmark_proxy* proxy);
/// Puts the proxy anywhere and forgets all contacts. Fails for a place that is not finite.
TOUCHMARK_API int touchmark_proxy_place(touchmark_proxy* proxy, const double position[3]);
/// To be called before touchmark_detector_update with that mesh, which may move the surface over the proxy.
/// The proxy goes straight to where the surface pushes it, and the next step's way begins with that. Returns
/// TOUCHMARK_YES, or TOUCHMARK_NO where no way out is found: it stays, and the surface may pass it. Fails for
/// a proxy that was never placed, for other triangles, and over grid-group and the published forms.
TOUCHMARK_API int touchmark_proxy_surface_moving(touchmark_proxy* proxy, const touchmark_mesh* mesh);
/// One tick: follows the goal, which is the device's tip, as far as the surface lets it. Takes no memory.
/// Returns TOUCHMARK_YES where the surface holds it and TOUCHMARK_NO where nothing does or the goal is no
/// number, and stores what came of it; `state` may be NULL. After touchmark_detector_update it goes on with
/// the surface as it is then. Fails for a proxy that was never placed.
TOUCHMARK_API int touchmark_proxy_step(touchmark_proxy* proxy, const double goal[3],
                                       touchmark_proxy_state* state);
/// Stores the planes that have held the proxy since its last step. Returns TOUCHMARK_YES or TOUCHMARK_ERROR.
TOUCHMARK_API int touchmark_proxy_planes(const touchmark_proxy* proxy, touchmark_force_planes* planes);
/// Stores the force on a device that has gone on to `goal` since that step, N: the step's own at the step's
/// goal, 0 where the goal has left the planes or is no number. Asks nothing. Returns TOUCHMARK_YES or
/// TOUCHMARK_ERROR.
TOUCHMARK_API int touchmark_force_now(const touchmark_force_planes* planes, const double goal[3],
                                      double force[3]);

/// Makes a scene without bodies.
TOUCHMARK_API touchmark_scene* touchmark_scene_create(void);
/// Frees a scene, once the last of its sessions is freed.
TOUCHMARK_API void touchmark_scene_free(touchmark_scene* scene);
/// Returns how many bodies there are; 0 for NULL.
TOUCHMARK_API size_t touchmark_scene_size(const touchmark_scene* scene);
/// Returns the memory that bodies and shapes take, in bytes; 0 for NULL.
TOUCHMARK_API size_t touchmark_scene_bytes(const touchmark_scene* scene);

/// Each of these five adds a shape, stores its number, and returns TOUCHMARK_YES or TOUCHMARK_ERROR. This one
/// is a mesh, searched by "sphere-cluster". The other shapes lie about the origin of the body's frame, and
/// their sizes are from 1e-30 to 1e30; only their surfaces count, from within as from without.
TOUCHMARK_API int touchmark_scene_add_mesh(touchmark_scene* scene, const touchmark_mesh* mesh,
                                           uint32_t* shape);
/// Adds a rectangle of two triangles in the plane z = 0, its corners at half the sizes to either side.
TOUCHMARK_API int touchmark_scene_add_plane(touchmark_scene* scene, double size_x, double size_y,
                                            uint32_t* shape);
/// Adds a box of 12 triangles, its corners at half the sizes to either side.
TOUCHMARK_API int touchmark_scene_add_box(touchmark_scene* scene, double size_x, double size_y, double size_z,
                                          uint32_t* shape);
/// Adds a sphere. Nothing of it is made of triangles: a contact's triangle is 0.
TOUCHMARK_API int touchmark_scene_add_sphere(touchmark_scene* scene, double radius, uint32_t* shape);
/// Adds a capsule: all points so far from the segment of that length along z, so that it is length + 2 radius
/// long. A contact's triangle is 0.
TOUCHMARK_API int touchmark_scene_add_capsule(touchmark_scene* scene, double radius, double length,
                                              uint32_t* shape);

/// Adds a body and stores its number, which no other body of the scene ever has. `orientation` is a
/// quaternion w, x, y, z of any length but zero; NULL is one that turns nothing. Fails for numbers that are
/// not finite. Returns TOUCHMARK_YES or TOUCHMARK_ERROR, as the next two do.
TOUCHMARK_API int touchmark_scene_add(touchmark_scene* scene, uint32_t shape, const double position[3],
                                      const double orientation[4], uint64_t* body);
/// Puts a body elsewhere. Both parts of its pose are given anew.
TOUCHMARK_API int touchmark_scene_move(touchmark_scene* scene, uint64_t body, const double position[3],
                                       const double orientation[4]);
/// Removes a body. Its shape stays.
TOUCHMARK_API int touchmark_scene_remove(touchmark_scene* scene, uint64_t body);

/// Begins a session. Takes memory; queries do not.
TOUCHMARK_API touchmark_scene_session* touchmark_scene_session_create(const touchmark_scene* scene);
/// Frees a session.
TOUCHMARK_API void touchmark_scene_session_free(touchmark_scene_session* session);
/// Is a body at most the radius away?
TOUCHMARK_API int touchmark_scene_touches(touchmark_scene_session* session, const double center[3],
                                          double radius);
/// As touchmark_nearest, of all bodies; stores whose the contact is in `body`, which may be NULL. Of several
/// bodies at the same distance it is the one that was added first, unless it has the place of one removed.
TOUCHMARK_API int touchmark_scene_nearest(touchmark_scene_session* session, const double center[3],
                                          double reach, touchmark_contact* contact, uint64_t* body);
/// As touchmark_first_hit, the bodies standing where they are.
TOUCHMARK_API int touchmark_scene_first_hit(touchmark_scene_session* session, const double from[3],
                                            const double to[3], double radius, touchmark_impact* impact,
                                            uint64_t* body);

#ifdef __cplusplus
}
#endif

#endif
