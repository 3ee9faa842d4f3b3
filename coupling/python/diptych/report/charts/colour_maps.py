# diptych: the colours of the maps
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every fifth of the 256 colours of matplotlib, whose import would take a tenth of the time of a page."""

import numpy as np

STOPS = {
    "cividis":
        "00224e 002656 002a5f 002d68 003070 083370 163770 203a6f 273e6e 2e416d 34456c 3a486c 3f4c6c 444f6c 49536c "
        "4e566c 535a6d 575d6d 5c616e 60646f 656870 696b71 6d6f72 727274 767676 7a7a78 7e7d78 838179 888578 8d8878 "
        "928c78 969077 9b9476 a09875 a59c74 aaa073 afa471 b5a86f baac6d bfb06b c4b468 c9b965 cfbd62 d4c15f dac65b "
        "dfca57 e5cf52 ead34c f0d846 f6dd3f fce236 fee838",
    "RdBu_r":
        "053061 0a3b70 10457e 15508d 1b5a9c 2065ab 276eb0 2e77b5 3480b9 3b88be 4291c2 4f9bc7 5fa5cd 6eaed2 7eb8d7 "
        "8dc2dc 9bc9e0 a7d0e4 b3d6e8 c0dceb cce2ef d5e7f1 ddebf2 e4eef4 ecf2f5 f3f5f6 f8f4f2 f9efe9 fae9df fbe4d6 "
        "fcdecd fcd7c2 fbccb4 f9c2a7 f7b799 f5ac8b f2a17f ec9374 e6866a e17860 db6b55 d55d4c ce4f45 c6413e bf3338 "
        "b82531 b1182b a21328 930e26 840924 760521 67001f",
    "viridis":
        "440154 46085c 471063 481769 481d6f 482475 472a7a 46307e 453781 433d84 414287 3f4889 3d4e8a 3a538b 38598c "
        "355e8d 33638d 31688e 2e6d8e 2c718e 2a768e 297b8e 27808e 25848e 23898e 218e8d 20928c 1f978b 1e9c89 1fa188 "
        "21a585 24aa83 28ae80 2eb37c 35b779 3dbc74 46c06f 50c46a 5ac864 65cb5e 70cf57 7cd250 89d548 95d840 a2da37 "
        "b0dd2f bddf26 cae11f d8e219 e5e419 f1e51d fde725",
}


def table(name):
    """The 256 colours of a map as text, within 4/255 of matplotlib's."""
    stops = np.array([list(bytes.fromhex(one)) for one in STOPS[name].split()], dtype=float)
    places = np.linspace(0, len(stops) - 1, 256)
    colours = np.column_stack([np.interp(places, np.arange(len(stops)), part) for part in stops.T])
    return ["#" + bytes(colour).hex() for colour in np.rint(colours).astype(np.uint8)]
