"""
ROS parameters: tables that declare, check and document them, and the files that set them.

``simulator`` holds the table of the simulator's node, ``table`` what all tables share, ``files``
what is checked before ROS reads a file.
"""
