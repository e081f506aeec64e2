"""Control laws: plain numbers in, plain numbers out; no ROS, no MuJoCo, no clock of their own."""
