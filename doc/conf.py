# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Settings of the documentation site; `make site` builds it, Read the Docs and rosdoc2 as well."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(Path(__file__).with_name('_ext')))

project = 'fluid_sim_ros'
author = 'fluid_sim_ros maintainers'
project_copyright = f'{author}, Apache-2.0'
# rosdoc2 copies doc/ to another place and says the version itself.
package = ROOT / 'fluid_sim_ros' / '__init__.py'
if package.exists():
    release = re.search(r"__version__ = '(.+)'", package.read_text(encoding='utf-8'))[1]
    version = release
    html_title = f'{project} {release}'

extensions = ['myst_parser', 'repository_pages']
source_suffix = {'.md': 'markdown'}
exclude_patterns = ['_ext', '_build']
myst_enable_extensions = ['html_image']
myst_heading_anchors = 4
# a block of code without a language holds commands
highlight_language = 'bash'
nitpicky = True

html_theme = 'furo'
html_static_path = []
html_search_scorer = str(Path(__file__).with_name('_ext') / 'scorer.js')
html_copy_source = False
html_show_sourcelink = False
# Read by repository_pages: headings of the contents, and the pages below them in order.
site_contents = {
    'Start': ['install', 'view', 'faq'],
    'Tutorials': [
        'tutorials/quad_topics',
        'tutorials/dive_bluerov2',
        'tutorials/own_vehicle',
        'tutorials/weather',
        'tutorials/autopilot',
        'tutorials/replay',
        'tutorials/model_and_timestep',
        'tutorials/sweep',
        'tutorials/real_flight',
    ],
    'Vehicles': ['vehicles/README', 'new_vehicle', 'import', 'hydro', 'fleets'],
    'The world': ['scenes', 'weather', 'waves', 'sensors'],
    'Autopilots': ['autopilots', 'autopilot_px4', 'autopilot_ardupilot'],
    'Results': ['logs', 'sweep', 'lab', 'lab_methods', 'reality', 'accuracy', 'validation'],
    'Reference': ['reference/*', 'parameters', 'ros_conventions', 'plugins', 'foil', 'thruster'],
    'Understand': ['physics', 'limits', 'robustness', 'network', 'speed'],
    'Project': ['project/*', 'development', 'extending'],
}
