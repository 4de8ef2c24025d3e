# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Everything that comes from outside. Each is linked by the folders that use it, never by all.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(spdlog REQUIRED)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs video calib3d features2d)
find_package(embree 3.13 REQUIRED)
find_package(GDAL 3.6 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(Ceres 2.1 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)

# OpenVINO's C++ package comes inside its Python wheel (scripts/setup.sh puts it into .venv).
find_program(REGOLITH_VENV_PYTHON python PATHS ${CMAKE_SOURCE_DIR}/.venv/bin NO_DEFAULT_PATH)
if(REGOLITH_VENV_PYTHON)
  execute_process(
    COMMAND ${REGOLITH_VENV_PYTHON} -c "import openvino.utils as u; print(u.get_cmake_path())"
    OUTPUT_VARIABLE openvino_cmake_path
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  list(APPEND CMAKE_PREFIX_PATH ${openvino_cmake_path})
endif()
find_package(OpenVINO REQUIRED COMPONENTS Runtime HINTS ${openvino_cmake_path})

# Debian's rosbag headers include those of pluginlib, class_loader and the rc* utilities from folders of their own.
add_library(regolith_rosbag INTERFACE)
target_include_directories(regolith_rosbag SYSTEM INTERFACE
  /usr/include/pluginlib /usr/include/class_loader /usr/include/rcpputils /usr/include/rcutils
  /usr/include/ament_index_cpp)
# Its CMake package would ask for the Python tools of ament; the libraries alone are enough.
foreach(library rosbag_storage roscpp_serialization rostime cpp_common roslz4 console_bridge)
  find_library(REGOLITH_LIBRARY_${library} ${library} REQUIRED)
  target_link_libraries(regolith_rosbag INTERFACE ${REGOLITH_LIBRARY_${library}})
endforeach()

# The ROS 1 nodes are built where ROS is found (scripts/setup.sh ros).
set(REGOLITH_ROS AUTO CACHE STRING "The ROS 1 nodes: ON, OFF, or AUTO where ROS is found")
set(REGOLITH_ROS_FOUND FALSE)
if(NOT REGOLITH_ROS STREQUAL "OFF")
  set(REGOLITH_ROS_FOUND TRUE)
  add_library(regolith_ros_client INTERFACE)
  target_link_libraries(regolith_ros_client INTERFACE regolith_rosbag)
  foreach(library roscpp rosconsole topic_tools xmlrpcpp)
    find_library(REGOLITH_LIBRARY_${library} ${library})
    if(REGOLITH_LIBRARY_${library})
      target_link_libraries(regolith_ros_client INTERFACE ${REGOLITH_LIBRARY_${library}})
    else()
      set(REGOLITH_ROS_FOUND FALSE)
    endif()
  endforeach()
  foreach(header ros/ros.h topic_tools/shape_shifter.h tf2_msgs/TFMessage.h std_srvs/Trigger.h
                 diagnostic_msgs/DiagnosticArray.h visualization_msgs/MarkerArray.h rosgraph_msgs/Clock.h)
    string(MAKE_C_IDENTIFIER ${header} name)
    find_path(REGOLITH_HEADER_${name} ${header})
    if(NOT REGOLITH_HEADER_${name})
      set(REGOLITH_ROS_FOUND FALSE)
    endif()
  endforeach()
  if(NOT REGOLITH_ROS_FOUND)
    if(REGOLITH_ROS STREQUAL "ON")
      message(FATAL_ERROR "REGOLITH_ROS is ON, but ROS 1 was not found; run scripts/setup.sh ros")
    endif()
    message(STATUS "ROS 1 was not found: its nodes are not built (scripts/setup.sh ros installs it)")
  endif()
endif()

# Debian's Ceres was compiled without AVX: its Eigen aligns to 16 bytes, ours to 32. The shared library keeps its own Eigen
# to itself; the static one, which the CMake package names, would share inline functions with ours.
find_library(REGOLITH_CERES_SHARED ceres REQUIRED)
set_target_properties(Ceres::ceres PROPERTIES IMPORTED_LOCATION_RELEASE ${REGOLITH_CERES_SHARED})

# Objects with Eigen members on the stack pass through Ceres too: 16 bytes of alignment there.
add_library(regolith_eigen INTERFACE)
target_link_libraries(regolith_eigen INTERFACE Eigen3::Eigen)
target_compile_definitions(regolith_eigen INTERFACE EIGEN_MAX_ALIGN_BYTES=16)

find_package(Git QUIET)
set(REGOLITH_COMMIT "unknown")
if(GIT_FOUND)
  execute_process(
    COMMAND ${GIT_EXECUTABLE} -C ${CMAKE_SOURCE_DIR} rev-parse --short=10 HEAD
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(REGOLITH_COMMIT ${commit})
  endif()
endif()
# Reports name the commit they were made with: configured anew with each one.
set(head_log ${CMAKE_SOURCE_DIR}/.git/logs/HEAD)
if(EXISTS ${head_log})
  set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${head_log})
endif()

if(REGOLITH_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(REGOLITH_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
