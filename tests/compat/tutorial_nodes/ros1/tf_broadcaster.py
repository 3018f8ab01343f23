"""Sends the frame of a turtle where its pose says it is, as the tf tutorial does."""

import rospy
import tf
import turtlesim.msg


def handle_turtle_pose(message, turtle):
    broadcaster = tf.TransformBroadcaster()
    broadcaster.sendTransform(
        (message.x, message.y, 0),
        tf.transformations.quaternion_from_euler(0, 0, message.theta),
        rospy.Time.now(),
        turtle,
        "world",
    )


if __name__ == "__main__":
    rospy.init_node("turtle_tf_broadcaster")
    name = rospy.get_param("~turtle", "turtle1")
    rospy.Subscriber(f"/{name}/pose", turtlesim.msg.Pose, handle_turtle_pose, name)
    rospy.spin()
