"""``rviz``, ``rqt_plot``, ``gzclient`` and their kin: each opens a panel of the one page."""
