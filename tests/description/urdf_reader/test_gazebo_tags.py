from __future__ import annotations


def test_words_of_the_whole_robot(read_link) -> None:
    robot = read_link(
        after="<gazebo><static>true</static><self_collide>1</self_collide>"
        "<allow_auto_disable>false</allow_auto_disable></gazebo>"
    ).robot
    assert (robot.static, robot.self_collide, robot.allow_auto_disable) == (True, True, False)


def test_plug_ins_keep_order_parameters_and_reference(read_link) -> None:
    robot = read_link(
        after="\n<gazebo><plugin name='one' filename='a.so'><x>1</x></plugin></gazebo>"
        "\n<gazebo reference='a'><plugin name='two' filename='b.so'/></gazebo>"
        "\n<gazebo><plugin name='three' filename='c.so'/></gazebo>"
    ).robot
    assert [(item.name, item.filename, item.reference) for item in robot.plugins] == [
        ("one", "a.so", ""),
        ("two", "b.so", "a"),
        ("three", "c.so", ""),
    ]
    assert robot.plugins[0].parameters.text_of("x") == "1"


def test_reference_to_the_world_is_said_to_have_no_effect_when_it_says_anything(read) -> None:
    found = read(
        '<robot name="r"><link name="world"/><link name="a"/><joint name="j" type="fixed">'
        '<parent link="world"/><child link="a"/></joint><gazebo reference="world"/>'
        '<gazebo reference="world"><static>true</static></gazebo>'
        '<gazebo reference="world"><mu1>1</mu1></gazebo></robot>'
    )
    (item,) = found.diagnostics.by_code("urdf.gazebo-reference")
    assert (
        item.message == "<gazebo reference='world'> means the world itself, where it has no effect"
    )


def test_reference_to_nothing_is_reported_with_the_nearest(read) -> None:
    found = read(
        '<robot name="r"><link name="wheel_left"/><gazebo reference="left_wheel"/>'
        '<gazebo reference="wheel_lft"><mu1>1</mu1></gazebo></robot>'
    )
    messages = [str(item) for item in found.diagnostics.by_code("urdf.gazebo-reference")]
    assert len(messages) == 2
    assert "'wheel_lft'> is neither a link nor a joint" in messages[1]
    assert "did you mean 'wheel_left'" in messages[1]


def test_old_controller_tags_become_plug_ins_with_a_notice(read_link) -> None:
    found = read_link(
        after="<gazebo><controller:gazebo_ros_time name='t' plugin='libgazebo_ros_time.so'>"
        "<updateRate>1000</updateRate></controller:gazebo_ros_time></gazebo>"
    )
    (plugin,) = found.robot.plugins
    assert (plugin.name, plugin.filename) == ("t", "libgazebo_ros_time.so")
    assert plugin.parameters.text_of("updateRate") == "1000"
    message = found.message("urdf.old-controller")
    assert "how plug-ins were written before Gazebo 1.0" in message
    assert 'write <plugin name="t" filename="libgazebo_ros_time.so">' in message


def test_words_without_effect_and_unknown_ones(read_link) -> None:
    found = read_link(after="<gazebo><enable_wind>true</enable_wind><statc>1</statc></gazebo>")
    assert "<enable_wind> for the whole robot has no effect" in found.message(
        "urdf.gazebo-no-effect"
    )
    assert "did you mean 'static'" in found.message("xml.unknown-tag")
