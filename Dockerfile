# fluid_sim_ros on ROS 2 Jazzy.
#   docker build --tag fluid_sim_ros .
#   docker run --rm fluid_sim_ros fluid_sim run x500 --duration 5
#   docker run --rm --network host --ipc host fluid_sim_ros \
#       fluid_sim_node --ros-args -p scene:=rov -p pacing:=realtime
FROM ros:jazzy AS build
SHELL ["/bin/bash", "-o", "pipefail", "-c"]
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --yes --no-install-recommends g++ python3-venv \
    && rm -rf /var/lib/apt/lists/*
WORKDIR /source
COPY . .
# The environment sees the system's rclpy and messages; the ROS wheels are not needed.
RUN python3 -m venv --system-site-packages /opt/fluid_sim \
    && /opt/fluid_sim/bin/pip install --no-cache-dir ".[record,render,charts,mavlink,parquet]"

FROM ros:jazzy
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --yes --no-install-recommends \
        libegl1 libegl-mesa0 ros-jazzy-common-interfaces ros-jazzy-tf2-msgs \
    && rm -rf /var/lib/apt/lists/*
COPY --from=build /opt/fluid_sim /opt/fluid_sim
# The first path wins: fluid_sim, the node and the controllers. Pictures without a screen: EGL.
ENV PATH="/opt/fluid_sim/bin:$PATH" \
    MUJOCO_GL=egl \
    ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST
# Not root: a stranger's model would be opened as the same user.
RUN install --directory --owner=1000 --group=1000 /flights
USER 1000
WORKDIR /flights
# The image's own entry point sources /opt/ros/jazzy/setup.bash.
CMD ["fluid_sim", "doctor"]
