using System;

namespace UnityEngine
{
    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>() where T : ScriptableObject => (T)CreateInstance(typeof(T));

        public static ScriptableObject CreateInstance(Type type)
        {
            var instance = (ScriptableObject)Activator.CreateInstance(type, true);
            var messages = Messages.Of(type);
            Messages.Send(messages.Awake, instance);
            Messages.Send(messages.OnEnable, instance);
            return instance;
        }
    }
}
