// Writes the figures that test_against_kdl.py compares with: trajectories of OROCOS KDL (made with Debian's 1.5.1).
//
//   g++ -O2 -I/usr/include/eigen3 kdl_reference.cpp -lorocos-kdl -o /tmp/kdl_reference && /tmp/kdl_reference .
//
// (Debian and Ubuntu: liborocos-kdl-dev.) One file per case, <case>.csv, a row per instant:
//   t [s], position [m], quaternion x y z w, linear velocity [m/s], angular velocity [rad/s] (both in the base frame).
// KDL's Vector::Normalize takes a vector shorter than 1e-6 for zero and puts the x axis in its place.
// Path_RoundedComposite normalises ab x (ab x bc), a, b and c being neighbouring via points; for the helix's 11 mm legs
// that is 1.1e-7 m3, so in metres every arc is laid about a wrong centre and ends up to millimetres from where the next
// leg starts. The helix is therefore made in millimetres, where KDL does what it says, and divided by 1000; one file
// keeps what it does in metres.
//
// Instants are spread evenly over lead and motion and rounded to 0.1 ms; everything else is rounded to 1e-8.

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <kdl/path_circle.hpp>
#include <kdl/path_line.hpp>
#include <kdl/path_roundedcomposite.hpp>
#include <kdl/rotational_interpolation_sa.hpp>
#include <kdl/trajectory_composite.hpp>
#include <kdl/trajectory_segment.hpp>
#include <kdl/trajectory_stationary.hpp>
#include <kdl/velocityprofile_trap.hpp>

using KDL::Frame;
using KDL::Rotation;
using KDL::Vector;

namespace {

std::string directory;

KDL::RotationalInterpolation* single_axis() { return new KDL::RotationalInterpolation_SingleAxis(); }

std::string decimal(double value, int places) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", places, value);
  std::string shortened(text);
  shortened.erase(shortened.find_last_not_of('0') + 1);
  if (shortened.back() == '.') shortened.pop_back();
  return shortened == "-0" ? "0" : shortened;
}

// units: how many of the path's units of length make a metre.
void record(const std::string& name, KDL::Path* path, double speed, double acceleration, double lead, int instants,
            double units = 1.0) {
  auto* profile = new KDL::VelocityProfile_Trap(speed, acceleration);
  profile->SetProfile(0.0, path->PathLength());
  KDL::Trajectory_Composite trajectory;
  if (lead > 0.0) trajectory.Add(new KDL::Trajectory_Stationary(lead, path->Pos(0.0)));
  trajectory.Add(new KDL::Trajectory_Segment(path, profile));

  std::ofstream file(directory + "/" + name + ".csv");
  file << "t,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";
  for (int k = 0; k < instants; ++k) {
    const double t = std::floor(trajectory.Duration() * k / (instants - 1) * 1e4) / 1e4;
    const Frame pose = trajectory.Pos(t);
    const KDL::Twist twist = trajectory.Vel(t);
    double q[4];
    pose.M.GetQuaternion(q[0], q[1], q[2], q[3]);
    file << decimal(t, 4);
    for (int i = 0; i < 3; ++i) file << ',' << decimal(pose.p(i) / units, 8);
    for (double value : q) file << ',' << decimal(value, 8);
    for (int i = 0; i < 3; ++i) file << ',' << decimal(twist.vel(i) / units, 8);
    for (int i = 0; i < 3; ++i) file << ',' << decimal(twist.rot(i), 8);
    file << '\n';
  }
}

// The thesis's helix (4.1): radius 0.15 m, pitch 0.08 m, from 0.01 m to 0.30 m, 301 via points, no turning.
void helix(const std::string& name, double corner_radius, int instants, double units) {
  const double radius = 0.15 * units, pitch = 0.08 * units, bottom = 0.01 * units, top = 0.30 * units;
  const int last = 300;
  auto* path = new KDL::Path_RoundedComposite(corner_radius * units, 0.002 * units, single_axis());
  for (int i = 0; i <= last; ++i) {
    const double z = bottom + (top - bottom) * i / last;
    const double azimuth = 2 * M_PI * (z - bottom) / pitch;
    path->Add(Frame(Vector(radius * std::cos(azimuth), radius * std::sin(azimuth), z)));
  }
  path->Finish();
  record(name, path, 0.1 * units, 0.02 * units, 1.0, instants, units);
}

// Six via points, unequal corners; legs on which turning sets the pace, on which travel does, and one without turning.
void turning() {
  auto* path = new KDL::Path_RoundedComposite(0.03, 0.05, single_axis());
  path->Add(Frame(Rotation::RPY(0.0, 0.0, 0.0), Vector(0.0, 0.0, 0.3)));
  path->Add(Frame(Rotation::RPY(0.1, -0.2, 0.3), Vector(0.2, 0.0, 0.3)));
  path->Add(Frame(Rotation::RPY(0.1, -0.2, 0.3), Vector(0.25, 0.2, 0.35)));
  path->Add(Frame(Rotation::RPY(2.9, 0.4, -1.0), Vector(0.22, 0.33, 0.30)));
  path->Add(Frame(Rotation::RPY(-1.2, 0.9, 2.0), Vector(0.05, 0.30, 0.2)));
  path->Add(Frame(Rotation::RPY(-1.0, 0.8, 1.9), Vector(-0.2, 0.1, 0.25)));
  path->Finish();
  record("turning", path, 0.2, 0.15, 0.5, 150);
}

void circle() {
  record("circle",
         new KDL::Path_Circle(Frame(Rotation::RPY(0.2, 0.1, 0.0), Vector(0.25, 0.05, 0.2)), Vector(0.1, 0.0, 0.25),
                              Vector(0.1, 0.2, 0.2), Rotation::RPY(-0.5, 0.4, 1.5), 1.5 * M_PI, single_axis(), 0.1),
         0.1, 0.05, 0.0, 150);
}

// 0.3 m is too short for 0.1 m/s at 0.02 m/s2, which needs 0.5 m: the profile is a triangle.
void short_line() {
  record("short_line",
         new KDL::Path_Line(Frame(Rotation::RPY(0.1, 0.2, 0.3), Vector(0.1, 0.0, 0.3)),
                            Frame(Rotation::RPY(-0.4, 0.6, 1.0), Vector(0.1, 0.3, 0.3)), single_axis(), 0.1),
         0.1, 0.02, 0.0, 50);
}

void turn_in_place() {
  record("turn_in_place",
         new KDL::Path_Line(Frame(Rotation::RPY(0.3, 0.0, 0.2), Vector(0.1, 0.2, 0.3)),
                            Frame(Rotation::RPY(-0.4, 0.6, 1.0), Vector(0.1, 0.2, 0.3)), single_axis(), 0.2),
         0.1, 0.1, 0.0, 50);
}

// Half a turn may go either way about its axis; this fixes which.
void half_turn() {
  const Rotation start = Rotation::RPY(0.3, -0.7, 0.2);
  record("half_turn",
         new KDL::Path_Line(Frame(start, Vector(0.1, 0.2, 0.3)),
                            Frame(start * Rotation::Rot(Vector(0.6, -0.75, 0.1), M_PI), Vector(0.2, 0.2, 0.3)),
                            single_axis(), 0.1),
         0.1, 0.1, 0.0, 50);
}

}  // namespace

int main(int argc, char** argv) {
  directory = argc > 1 ? argv[1] : ".";
  helix("helix_corner_0.02", 0.02, 1000, 1000.0);
  helix("helix_corner_0.14", 0.14, 1000, 1000.0);
  helix("helix_corner_0.02_in_metres", 0.02, 120, 1.0);
  turning();
  circle();
  short_line();
  turn_in_place();
  half_turn();
}
