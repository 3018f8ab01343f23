from __future__ import annotations

from gazelle.description.model import ContactSpec, ImuSpec, LidarSpec, Surface

SPHERE = "<geometry><sphere radius='1'/></geometry>"
TOUCHES = f"<collision>{SPHERE}</collision>"


def _block(inside: str, reference: str = "a") -> str:
    return f"<gazebo reference='{reference}'>{inside}</gazebo>"


def test_contact_words_act_on_every_collision(read_link) -> None:
    words = (
        "<mu1>0.3</mu1><mu2 value='0.4'/><kp>1e6</kp><kd>10</kd><minDepth>0.002</minDepth>"
        "<maxVel>0.2</maxVel><fdir1>0 2 0</fdir1><maxContacts>5</maxContacts>"
        "<laserRetro>0.5</laserRetro>"
    )
    found = read_link(TOUCHES + TOUCHES, after=_block(words))
    for collision in found.robot.link("a").collisions:
        assert collision.surface == Surface(
            mu1=0.3,
            mu2=0.4,
            kp=1e6,
            kd=10.0,
            min_depth_m=0.002,
            max_vel_m_s=0.2,
            fdir1=(0.0, 1.0, 0.0),
            max_contacts=5,
        )
        assert collision.laser_retro == 0.5
    assert not found.codes


def test_later_blocks_win_and_what_is_not_said_stays_the_default(read_link) -> None:
    found = read_link(TOUCHES, after=_block("<mu1>1</mu1>") + _block("<mu1>2</mu1><kp>3</kp>"))
    surface = found.robot.link("a").collisions[0].surface
    assert (surface.mu1, surface.kp, surface.mu2) == (2.0, 3.0, None)


def test_embedded_surface_is_the_base_of_the_single_words(read_link) -> None:
    block = (
        "<collision><surface><bounce><restitution_coefficient>0.5</restitution_coefficient>"
        "</bounce><friction><ode><mu>0.1</mu></ode></friction></surface>"
        "<max_contacts>3</max_contacts><laser_retro>7</laser_retro></collision><mu1>2</mu1>"
    )
    collision = read_link(TOUCHES, after=_block(block)).robot.link("a").collisions[0]
    assert (collision.surface.restitution, collision.surface.mu1) == (0.5, 2.0)
    assert (collision.surface.max_contacts, collision.laser_retro) == (3, 7.0)


def test_contact_words_without_a_collision_are_reported(read_link) -> None:
    message = read_link(after=_block("<kp>1</kp>")).message("urdf.gazebo-no-collision")
    assert "<kp> for link 'a' has no effect: it has no <collision>" in message


def test_named_collision_gets_the_values_and_gazebo_s_quirk_is_told(read_link) -> None:
    found = read_link(f"<collision name='front'>{SPHERE}</collision>", after=_block("<mu1>2</mu1>"))
    assert found.robot.link("a").collisions[0].surface.mu1 == 2.0
    assert "Gazebo would pass over 'front'" in found.message("urdf.gazebo-named-shape")
    named = read_link(f"<collision name='a_x'>{SPHERE}</collision>", after=_block("<mu1>2</mu1>"))
    assert not named.codes


def test_words_of_the_link(read_link) -> None:
    found = read_link(
        after=_block(
            "<turnGravityOff>true</turnGravityOff><selfCollide>1</selfCollide>"
            "<dampingFactor>0.3</dampingFactor><kinematic>true</kinematic><canonicalBody/>"
            "<light name='lamp' type='point'/>"
        )
    )
    link = found.robot.link("a")
    assert (link.gravity, link.self_collide, link.kinematic) == (False, True, True)
    assert (link.linear_damping, link.angular_damping) == (0.3, 0.3)
    assert [light.name for light in link.lights] == ["lamp"]
    assert not found.codes


def test_sdf_words_of_the_link(read_link) -> None:
    words = (
        "<gravity>false</gravity><self_collide>false</self_collide>"
        "<velocity_decay><linear>1</linear><angular>2</angular></velocity_decay>"
    )
    link = read_link(after=_block(words)).robot.link("a")
    assert (link.gravity, link.self_collide) == (False, False)
    assert (link.linear_damping, link.angular_damping) == (1.0, 2.0)


def test_material_names_a_gazebo_script_and_wins(read_link) -> None:
    own = "<material name=''><color rgba='1 1 1 1'/></material>"
    found = read_link(
        f"<visual>{SPHERE}{own}</visual>", after=_block("<material> Gazebo/Red </material>")
    )
    material = found.robot.link("a").visuals[0].material
    assert (material.name, material.diffuse) == ("Gazebo/Red", (1.0, 0.0, 0.0, 1.0))


def test_material_with_elements_inside_is_told_how_to_write_it(read_link) -> None:
    script = "<script><uri>a</uri><name>Gazebo/Orange</name></script>"
    found = read_link(after=_block(f"<material>{script}</material>"))
    (item,) = found.diagnostics.by_code("urdf.gazebo-material")
    assert "where the text is the name of a material" in item.message
    assert item.fix == "write <material>Gazebo/Orange</material>"


def test_unknown_material_is_reported_with_the_nearest(read_link) -> None:
    found = read_link(after=_block("<material>Gazebo/Redd</material>"))
    assert "did you mean 'Gazebo/Red'" in found.message("urdf.gazebo-material")


def test_visual_block_changes_the_look(read_link) -> None:
    block = (
        "<visual><material><diffuse>0 1 0 1</diffuse></material><transparency>0.5</transparency>"
        "<cast_shadows>false</cast_shadows><laser_retro>3</laser_retro></visual>"
    )
    visual = read_link(f"<visual>{SPHERE}</visual>", after=_block(block)).robot.link("a").visuals[0]
    assert visual.material.diffuse == (0.0, 1.0, 0.0, 1.0)
    assert (visual.transparency, visual.cast_shadows, visual.laser_retro) == (0.5, False, 3.0)


def test_sensor_keeps_its_pose_and_its_plug_in(read_link) -> None:
    found = read_link(
        after=_block(
            "<sensor type='ray' name='scan'><pose>0 0 1 0 0 0</pose><update_rate>5.5</update_rate>"
            "<ray><scan><horizontal><samples>360</samples><min_angle>-3</min_angle>"
            "<max_angle>3</max_angle></horizontal></scan><range><min>0.1</min><max>6</max></range>"
            "</ray><plugin name='p' filename='libgazebo_ros_laser.so'><topicName>/scan</topicName>"
            "</plugin></sensor><sensor type='imu' name='imu'/>"
        )
    )
    scan, imu = found.robot.link("a").sensors
    assert isinstance(scan.spec, LidarSpec)
    assert (scan.update_rate_hz, scan.spec.samples) == (5.5, 360)
    assert scan.T_link_sensor.position_m == (0.0, 0.0, 1.0)
    assert scan.plugins[0].parameters.text_of("topicName") == "/scan"
    assert isinstance(imu.spec, ImuSpec)


def test_contact_sensor_watches_collisions_by_their_urdf_names(read_link) -> None:
    contact = (
        "<sensor type='contact' name='c'><contact>"
        "<collision>base_fixed_joint_lump__a_collision_2</collision></contact></sensor>"
    )
    (sensor,) = read_link(TOUCHES, after=_block(contact)).robot.link("a").sensors
    assert isinstance(sensor.spec, ContactSpec)
    assert sensor.spec.collisions == ("a_collision",)


def test_unknown_words_are_reported_with_the_nearest(read_link) -> None:
    message = read_link(after=_block("<mu3>1</mu3>")).message("xml.unknown-tag")
    assert "<mu3> is not known in <gazebo> for link 'a'" in message
    inner = read_link(TOUCHES, after=_block("<collision><surfaces/></collision>"))
    assert "did you mean 'surface'" in inner.message("xml.unknown-tag")
    visual = read_link(f"<visual>{SPHERE}</visual>", after=_block("<visual><plug/></visual>"))
    assert "<plug> is not known in <gazebo> for a visual" in visual.message("xml.unknown-tag")


def test_bad_number_is_reported_and_not_used(read_link) -> None:
    found = read_link(TOUCHES, after=_block("<mu1>slippery</mu1><kp/>"))
    assert found.codes == ["xml.bad-number", "xml.bad-number"]
    assert found.robot.link("a").collisions[0].surface.mu1 is None


def test_slip_works_in_a_surface_and_only_there(read_link) -> None:
    ode = "<ode><slip1>0.1</slip1><slip2>0.2</slip2></ode>"
    surface = f"<surface><friction>{ode}</friction></surface>"
    found = read_link(TOUCHES, after=_block(f"<collision>{surface}</collision>"))
    slips = found.robot.link("a").collisions[0].surface
    assert (slips.slip1, slips.slip2) == (0.1, 0.2)
    assert not found.codes
    single = read_link(TOUCHES, after=_block("<slip1>0.1</slip1>"))
    assert single.robot.link("a").collisions[0].surface.slip1 is None
    assert "<collision><surface><friction><ode><slip1>" in single.message("urdf.gazebo-no-effect")


def test_projector_is_legal_and_not_simulated(read_link) -> None:
    found = read_link(TOUCHES, after=_block("<projector name='p'/>"))
    (item,) = found.diagnostics.by_code("sdf.not-simulated")
    assert "<projector> in <gazebo> for" in item.message
    assert not found.diagnostics.by_code("xml.unknown-tag")
