/* A ball is lowered onto a plate, in C. */
#include <stdio.h>
#include <touchmark/touchmark.h>

int main(void) {
  /* A square plate in the plane z = 0, in metres. */
  const double vertices[] = {0, 0, 0, 0.1, 0, 0, 0.1, 0.1, 0, 0, 0.1, 0};
  const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  const double radius = 0.005;
  double center[3] = {0.04, 0.03, 0.0058};
  touchmark_impact impact;
  int tick;

  /* A function that makes something returns NULL when it cannot, and the next one fails for that NULL: it is
     enough to check the last. */
  touchmark_mesh* mesh = touchmark_mesh_create(vertices, 4, triangles, 2);
  touchmark_detector* detector = touchmark_detector_build(mesh, "sphere-cluster");
  touchmark_session* session = touchmark_session_create(detector);
  touchmark_mesh_free(mesh);
  if (session == NULL) {
    fprintf(stderr, "%s\n", touchmark_last_error());
    return 1;
  }

  for (tick = 0; tick < 4; ++tick) {
    touchmark_contact contact;
    if (touchmark_nearest(session, center, radius, &contact) == TOUCHMARK_YES) {
      printf("tick %d: %.2f N, triangle %u\n", tick, 500 * (radius - contact.distance) * contact.normal[2],
             (unsigned)contact.triangle);
    } else {
      printf("tick %d: free\n", tick);
    }
    touchmark_prepare(session); /* A real loop sleeps first, and does this right after waking. */
    center[2] -= 0.0005;
  }

  {
    const double from[3] = {0.04, 0.03, 0.01}, to[3] = {0.04, 0.03, -0.01};
    if (touchmark_first_hit(session, from, to, radius, &impact) == TOUCHMARK_YES)
      printf("first touch at %.2f of the way\n", impact.fraction);
  }
  {
    /* A proxy follows the device's tip and stays on its side of the plate. */
    touchmark_coupling coupling;
    touchmark_proxy* proxy;
    double tip[3] = {0.04, 0.03, 0.007};
    touchmark_coupling_default(&coupling);
    coupling.radius = radius;
    coupling.stiffness = 500;
    proxy = touchmark_proxy_create(detector, &coupling);
    touchmark_proxy_place(proxy, tip); /* It fails for a proxy that is NULL, and so does each step. */
    for (tick = 0; tick < 3; ++tick) {
      touchmark_proxy_state state;
      if (touchmark_proxy_step(proxy, tip, &state) == TOUCHMARK_ERROR) {
        fprintf(stderr, "%s\n", touchmark_last_error());
        return 1;
      }
      printf("tip at %.3f m, ball at %.3f m: %.2f N\n", tip[2], state.position[2], state.force[2]);
      tip[2] -= 0.004;
    }
    touchmark_proxy_free(proxy);
  }
  if (touchmark_nearest(session, center, -1, NULL) == TOUCHMARK_ERROR) printf("%s\n", touchmark_last_error());
  touchmark_session_free(session);
  touchmark_detector_free(detector);
  return 0;
}
