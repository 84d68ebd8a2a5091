// When leaves are listed for the ticks ahead: not where the last lists have cost more than descents.
#include "core/point_queries/leaf_cache.h"

#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "bench/meshes/meshes.h"
#include "bench/trajectories/trajectories.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {
namespace {

using queries::LeafCache;

/// Counts one refill and so many searches of its list that look at so many spheres each. Returns true if the
/// cache may be refilled after them.
bool lists_again_after(LeafCache& cache, std::size_t searches, std::uint64_t spheres) {
  cache.count_refill(80);
  for (std::size_t i = 0; i < searches; ++i) cache.count_search(spheres, 0);
  return cache.may_refill();
}

LeafCache cache_that_knows_a_descent() {
  LeafCache cache;
  EXPECT_FALSE(cache.may_refill());  // a descent is to tell what it costs
  cache.count_descent(40, 8);
  EXPECT_TRUE(cache.may_refill());
  return cache;
}

TEST(LeafCache, ListsAgainWhereTheLastListHasSaved) {
  LeafCache cache = cache_that_knows_a_descent();
  for (int list = 0; list < 10; ++list) EXPECT_TRUE(lists_again_after(cache, 16, 24));
}

TEST(LeafCache, WaitsForLongerEachTimeThatAListHasNotSaved) {
  LeafCache cache = cache_that_knows_a_descent();
  int last_wait = 0;
  for (int list = 0; list < 5; ++list) {
    EXPECT_FALSE(lists_again_after(cache, 3, 2000));
    int wait = 1;
    while (!cache.may_refill()) ++wait;
    EXPECT_GT(wait, last_wait);
    last_wait = wait;
  }
}

TEST(LeafCache, OneListThatIsLeftAtOnceAmongThoseThatSaveIsForgiven) {
  LeafCache cache = cache_that_knows_a_descent();
  for (int list = 0; list < 3; ++list) EXPECT_TRUE(lists_again_after(cache, 16, 24));
  EXPECT_TRUE(lists_again_after(cache, 1, 500));
}

TEST(LeafCache, ADescentTellsAnewNowAndThen) {
  LeafCache cache = cache_that_knows_a_descent();
  int lists = 0;
  while (lists < 1000 && lists_again_after(cache, 16, 24)) ++lists;
  EXPECT_LT(lists, 100);
}

/// What the queries of a session that goes on have looked at, and those of one that may not list.
struct BothWorks {
  Work goes_on, descends;
};

BothWorks works_of(const char* name, const char* motion) {
  const TriangleMesh mesh = bench::meshes::load_mesh(name, false);
  const auto detector = SphereCluster::build(mesh);
  const double reach = 0.005 * mesh.diagonal();
  bench::trajectories::TrajectoryOptions options;
  options.steps = 2000;
  options.radius = reach;
  const auto trajectory = bench::trajectories::make_trajectory(motion, mesh, options);
  SphereCluster::Session goes_on, descends;
  for (const Vec3& place : trajectory.positions) {
    detector.nearest({place, reach}, reach, goes_on);
    descends.memory.cache.start_anew();
    descends.memory.cache.backoff.left = 2;
    detector.nearest({place, reach}, reach, descends);
  }
  return {goes_on.work, descends.work};
}

TEST(LeafCache, BesideThousandsOfThinPlatesListsAreGivenUp) {
  const BothWorks works = works_of("fins:120000", "approach:speed=0.1%");
  EXPECT_LT(works.goes_on.triangles, 2 * works.descends.triangles);  // five times as many where it listed on
}

TEST(LeafCache, AlongASmoothSurfaceListsSaveMostSpheres) {
  const BothWorks works = works_of("icosphere:5", "slide:speed=0.05%");
  EXPECT_LT(2 * works.goes_on.spheres, works.descends.spheres);
  EXPECT_LT(works.goes_on.triangles, 1.1 * static_cast<double>(works.descends.triangles));
}

}  // namespace
}  // namespace touchmark
