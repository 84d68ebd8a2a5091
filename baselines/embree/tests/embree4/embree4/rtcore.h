/// What baselines/embree uses of Embree 4's interface, declared as its reference manual has it: enough to
/// compile against where only Embree 3 is installed. Nothing here is ever linked or run.
#pragma once

#include <cstddef>

#include <sys/types.h>

#define RTC_VERSION_MAJOR 4
#define RTC_MAX_INSTANCE_LEVEL_COUNT 1

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;
using RTCDevice = RTCDeviceTy*;
using RTCScene = RTCSceneTy*;
using RTCGeometry = RTCGeometryTy*;

enum RTCError { RTC_ERROR_NONE, RTC_ERROR_UNKNOWN };
enum RTCFormat {
  RTC_FORMAT_UINT3 = 0x5003,
  RTC_FORMAT_FLOAT3 = 0x9003,
  RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR = 0x9234
};
enum RTCBufferType { RTC_BUFFER_TYPE_INDEX, RTC_BUFFER_TYPE_VERTEX };
enum RTCGeometryType {
  RTC_GEOMETRY_TYPE_TRIANGLE,
  RTC_GEOMETRY_TYPE_USER = 120,
  RTC_GEOMETRY_TYPE_INSTANCE = 121
};
enum RTCBuildQuality {
  RTC_BUILD_QUALITY_LOW,
  RTC_BUILD_QUALITY_MEDIUM,
  RTC_BUILD_QUALITY_HIGH,
  RTC_BUILD_QUALITY_REFIT
};
enum RTCSceneFlags {
  RTC_SCENE_FLAG_NONE = 0,
  RTC_SCENE_FLAG_DYNAMIC = 1,
  RTC_SCENE_FLAG_COMPACT = 2,
  RTC_SCENE_FLAG_ROBUST = 4,
  RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS = 8
};
inline RTCSceneFlags operator|(RTCSceneFlags a, RTCSceneFlags b) {
  return static_cast<RTCSceneFlags>(static_cast<int>(a) | static_cast<int>(b));
}

struct alignas(16) RTCBounds {
  float lower_x, lower_y, lower_z, align0;
  float upper_x, upper_y, upper_z, align1;
};
struct RTCBoundsFunctionArguments {
  void* geometryUserPtr;
  unsigned int primID;
  unsigned int timeStep;
  RTCBounds* bounds_o;
};
struct alignas(16) RTCPointQuery {
  float x, y, z, time, radius;
};
struct alignas(16) RTCPointQueryContext {
  float world2inst[RTC_MAX_INSTANCE_LEVEL_COUNT][16];
  float inst2world[RTC_MAX_INSTANCE_LEVEL_COUNT][16];
  unsigned int instID[RTC_MAX_INSTANCE_LEVEL_COUNT];
  unsigned int instPrimID[RTC_MAX_INSTANCE_LEVEL_COUNT];
  unsigned int instStackSize;
};
struct alignas(16) RTCPointQueryFunctionArguments {
  RTCPointQuery* query;
  void* userPtr;
  unsigned int primID;
  unsigned int geomID;
  RTCPointQueryContext* context;
  float similarityScale;
};

extern "C" {
using RTCBoundsFunction = void (*)(const RTCBoundsFunctionArguments*);
using RTCPointQueryFunction = bool (*)(RTCPointQueryFunctionArguments*);
using RTCMemoryMonitorFunction = bool (*)(void* ptr, ssize_t bytes, bool post);

RTCDevice rtcNewDevice(const char* config);
void rtcReleaseDevice(RTCDevice device);
RTCError rtcGetDeviceError(RTCDevice device);
void rtcSetDeviceMemoryMonitorFunction(RTCDevice device, RTCMemoryMonitorFunction function, void* user);

RTCScene rtcNewScene(RTCDevice device);
void rtcReleaseScene(RTCScene scene);
void rtcSetSceneFlags(RTCScene scene, RTCSceneFlags flags);
void rtcSetSceneBuildQuality(RTCScene scene, RTCBuildQuality quality);
void rtcCommitScene(RTCScene scene);
unsigned int rtcAttachGeometry(RTCScene scene, RTCGeometry geometry);
void rtcAttachGeometryByID(RTCScene scene, RTCGeometry geometry, unsigned int geomID);
RTCGeometry rtcGetGeometry(RTCScene scene, unsigned int geomID);

RTCGeometry rtcNewGeometry(RTCDevice device, RTCGeometryType type);
void rtcReleaseGeometry(RTCGeometry geometry);
void rtcCommitGeometry(RTCGeometry geometry);
void rtcSetGeometryBuildQuality(RTCGeometry geometry, RTCBuildQuality quality);
void* rtcSetNewGeometryBuffer(RTCGeometry geometry, RTCBufferType type, unsigned int slot, RTCFormat format,
                              std::size_t byteStride, std::size_t itemCount);
void rtcUpdateGeometryBuffer(RTCGeometry geometry, RTCBufferType type, unsigned int slot);
void rtcSetGeometryInstancedScene(RTCGeometry geometry, RTCScene scene);
void rtcSetGeometryTransform(RTCGeometry geometry, unsigned int timeStep, RTCFormat format, const void* xfm);
void rtcSetGeometryUserPrimitiveCount(RTCGeometry geometry, unsigned int count);
void rtcSetGeometryUserData(RTCGeometry geometry, void* user);
void rtcSetGeometryBoundsFunction(RTCGeometry geometry, RTCBoundsFunction function, void* user);

void rtcInitPointQueryContext(RTCPointQueryContext* context);
bool rtcPointQuery(RTCScene scene, RTCPointQuery* query, RTCPointQueryContext* context,
                   RTCPointQueryFunction function, void* user);
}
